#include "shape/features/boundary_loops.h"

#include "exact/orient.h"
#include "shape/complex/exact_complex.h"
#include "shape/features/canonical_order.h"

namespace dymsum::shape {
namespace {

bool less(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Sites [first, last) are one loop: edges in order, each perhaps led by the convex vertex that it starts at, or a
/// point.
void add_loop(const Complex& complex, std::uint32_t first, std::uint32_t last, BoundaryLoops& loops) {
  BoundaryLoop loop;
  loop.first = std::uint32_t(loops.vertices.size());
  loop.component = complex.sites[first].component;
  const std::uint32_t index = std::uint32_t(loops.loops.size());
  bool any_edge = false;
  for (std::uint32_t s = first; s < last; ++s) any_edge = any_edge || complex.sites[s].kind == Site::Kind::edge;
  for (std::uint32_t s = first; s < last; ++s) {
    const Site& site = complex.sites[s];
    if (site.kind == Site::Kind::vertex && any_edge) continue;
    LoopVertex v;
    v.at = site.a;
    v.edge = any_edge ? s : kNoIndex;
    const std::uint32_t led = s == first ? last - 1 : s - 1;
    const bool convex = !any_edge || (complex.sites[led].kind == Site::Kind::vertex);
    v.convex = convex;
    v.vertex = !any_edge ? site.index : convex ? complex.sites[led].index : kNoIndex;
    loops.vertices.push_back(v);
  }
  loop.last = std::uint32_t(loops.vertices.size());
  loops.loop_of.resize(loop.last, index);
  loops.loops.push_back(loop);
  // Where a contact of each site lies among the vertices.
  std::uint32_t at = loop.last - 1;
  for (std::uint32_t s = first; s < last; ++s) {
    const bool edge = complex.sites[s].kind == Site::Kind::edge;
    if (edge) at = at + 1 == loop.last ? loop.first : at + 1;
    loops.loop_of_site[s] = index;
    loops.before[s] = at;
    loops.after[s] = edge ? loops.next(at) : loops.next(loops.next(at));
    if (!any_edge) loops.before[s] = loops.after[s] = loop.first;
  }
}

/// The vertices of reflex corners are known to the nodes at radius 0.
void name_corners(const Complex& complex, BoundaryLoops& loops) {
  for (const Edge& e : complex.edges) {
    const Node& low = complex.nodes[e.low];
    if (low.kind != Node::Kind::corner) continue;
    loops.vertices[loops.after[e.right]].vertex = low.vertex;
  }
}

/// -1, 0, 1: d lies less far to the left of the line a -> b than c, as far, farther.
int farther(Point a, Point b, Point c, Point d) { return exact::cross_sign(a, b, c, d); }

void find_outermost(const BoundaryLoops& loops, BoundaryLoop& loop) {
  const auto at = [&](std::uint32_t v) { return loops.vertices[v].at; };
  std::uint32_t low = loop.first, high = loop.first;
  const auto better = [&](std::uint32_t v, std::uint32_t than, bool smaller) {
    if (at(v) == at(than)) return loops.vertices[v].convex && !loops.vertices[than].convex;
    return smaller ? less(at(v), at(than)) : less(at(than), at(v));
  };
  for (std::uint32_t v = loop.first; v < loop.last; ++v) {
    if (better(v, low, true)) low = v;
    if (better(v, high, false)) high = v;
  }
  loop.encloses = !loops.vertices[low].convex;
  if (loop.encloses) return;
  std::uint32_t left = low, right = low;
  for (std::uint32_t v = loop.first; v < loop.last; ++v) {
    if (!loops.vertices[v].convex) continue;
    if (farther(at(low), at(high), at(left), at(v)) > 0) left = v;
    if (farther(at(low), at(high), at(right), at(v)) < 0) right = v;
  }
  loop.outermost = {low, high, left != low ? left : right != low ? right : kNoIndex};
}

}  // namespace

std::uint32_t BoundaryLoops::next(std::uint32_t v) const {
  const BoundaryLoop& loop = loops[loop_of[v]];
  return v + 1 == loop.last ? loop.first : v + 1;
}

std::uint32_t BoundaryLoops::previous(std::uint32_t v) const {
  const BoundaryLoop& loop = loops[loop_of[v]];
  return v == loop.first ? loop.last - 1 : v - 1;
}

std::uint32_t length(const BoundaryLoops& loops, const BoundaryChain& chain) {
  const BoundaryLoop& loop = loops.loops[chain.loop];
  return (chain.last >= chain.first ? chain.last - chain.first : loop.last - loop.first - (chain.first - chain.last)) +
         1;
}

bool holds(const BoundaryLoops& loops, const BoundaryChain& chain, std::uint32_t vertex) {
  if (loops.loop_of[vertex] != chain.loop) return false;
  if (chain.first <= chain.last) return chain.first <= vertex && vertex <= chain.last;
  return vertex >= chain.first || vertex <= chain.last;
}

BoundaryLoops boundary_loops(const Complex& complex) {
  BoundaryLoops loops;
  const std::uint32_t n = std::uint32_t(complex.sites.size());
  loops.before.resize(n);
  loops.after.resize(n);
  loops.loop_of_site.resize(n);
  for (std::uint32_t first = 0, last = 0; first < n; first = last) {
    while (last < n && complex.sites[last].loop == complex.sites[first].loop) ++last;
    add_loop(complex, first, last, loops);
  }
  name_corners(complex, loops);
  for (BoundaryLoop& loop : loops.loops) find_outermost(loops, loop);
  loops.rank = canonical_ranks(loops, complex.exact->walks);
  return loops;
}

}  // namespace dymsum::shape
