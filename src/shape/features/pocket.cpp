#include "shape/features/pocket.h"

#include <algorithm>
#include <cmath>

#include "shape/features/geodesic.h"

namespace dymsum::shape {
namespace {

bool holds_outermost(const BoundaryLoops& loops, const BoundaryChain& chain) {
  const auto& outermost = loops.loops[chain.loop].outermost;
  return std::any_of(outermost.begin(), outermost.end(),
                     [&](std::uint32_t v) { return v != kNoIndex && holds(loops, chain, v); });
}

Bridge bridge_between(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge, Position left,
                      Position right) {
  const PocketSide side = pocket_side(complex, loops, edge);
  const Edge& e = complex.edges[edge];
  if (side.ahead) return {std::move(left), std::move(right), e.left, e.right, side.chain};
  return {std::move(right), std::move(left), e.right, e.left, side.chain};
}

/// Whether an edge of the chain runs backwards along the bridge: only then may shortest paths turn at vertices.
bool turns_back(const BoundaryLoops& loops, const Bridge& bridge) {
  const BoundaryChain& chain = *bridge.pocket;
  Position last = bridge.from;
  for (std::uint32_t v = chain.first;; v = loops.next(v)) {
    const Position here{loops.vertices[v].at, nullptr};
    if (dot_sign(bridge.from, bridge.to, last, here) < 0) return true;
    last = here;
    if (v == chain.last) break;
  }
  return dot_sign(bridge.from, bridge.to, last, bridge.to) < 0;
}

Deepest straight_minimum(const BoundaryLoops& loops, const ChainExtremes& extremes, const Bridge& bridge) {
  const std::uint32_t v = extremes.farthest(*bridge.pocket, bridge.from, bridge.to);
  return {v, distance_left(bridge.from, bridge.to, {loops.vertices[v].at, nullptr})};
}

Deepest geodesic_minimum(const BoundaryLoops& loops, const Bridge& bridge) {
  std::vector<Position> chain;
  for (std::uint32_t v = bridge.pocket->first;; v = loops.next(v)) {
    chain.push_back({loops.vertices[v].at, nullptr});
    if (v == bridge.pocket->last) break;
  }
  const std::vector<double> far = distances_from_bridge(bridge.from, chain, bridge.to);
  Deepest best;
  std::uint32_t v = bridge.pocket->first;
  for (const double distance : far) {
    const bool first = best.vertex == kNoIndex;
    if (first || distance > best.concavity || (distance == best.concavity && loops.rank[v] < loops.rank[best.vertex]))
      best = {v, distance};
    v = loops.next(v);
  }
  return best;
}

}  // namespace

PocketSide pocket_side(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge) {
  const std::uint32_t left = complex.edges[edge].left, right = complex.edges[edge].right;
  const std::uint32_t loop = loops.loop_of_site[left];
  if (loops.loop_of_site[right] != loop) return {};
  const BoundaryChain behind{loop, loops.after[right], loops.before[left]};
  if (!holds_outermost(loops, behind)) return {behind, false};
  return {BoundaryChain{loop, loops.after[left], loops.before[right]}, true};
}

Bridge bridge_at_end(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge) {
  const Edge& e = complex.edges[edge];
  if (e.high == kNoIndex) {
    const Position left{complex.sites[e.left].a, nullptr}, right{complex.sites[e.right].a, nullptr};
    return bridge_between(complex, loops, edge, left, right);
  }
  if (complex.sites[e.left].kind == Site::Kind::vertex && complex.sites[e.right].kind == Site::Kind::vertex)
    return bridge_between(complex, loops, edge, {complex.sites[e.left].a, nullptr},
                          {complex.sites[e.right].a, nullptr});
  const Centre centre = centre_of(complex, e.high);
  return bridge_between(complex, loops, edge, contact_position(complex, e.left, centre),
                        contact_position(complex, e.right, centre));
}

Bridge bridge_at(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge, const Rational& r) {
  const Edge& e = complex.edges[edge];
  const Centre centre{exact_centre_on_edge(complex, edge, r)};
  return bridge_between(complex, loops, edge, contact_position(complex, e.left, centre),
                        contact_position(complex, e.right, centre));
}

Deepest pocket_minimum(const BoundaryLoops& loops, const ChainExtremes& extremes, const Bridge& bridge,
                       const FeatureOptions& options) {
  const bool shortest = options.concavity == Concavity::shortest_path ||
                        (options.concavity == Concavity::hybrid1 && turns_back(loops, bridge));
  if (shortest) return geodesic_minimum(loops, bridge);
  const Deepest straight = straight_minimum(loops, extremes, bridge);
  if (options.concavity == Concavity::hybrid2 && straight.concavity <= options.hybrid_tolerance)
    return geodesic_minimum(loops, bridge);
  return straight;
}

}  // namespace dymsum::shape
