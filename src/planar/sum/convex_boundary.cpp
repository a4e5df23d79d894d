#include "planar/sum/convex_boundary.h"

#include <cstddef>

#include "exact/rounding_bound.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/contact_of.h"

namespace dymsum::planar {
namespace {

// The error of the difference of two extents is this times the sum of both operands' sizes: coordinates (3), their
// differences, what is left and the error taken off, 3 + 1 + 1 + 1 roundings of one extent and 3 + 1 + 1 of the other.
constexpr double kExtents = exact::rounding_bound(11, 128);

// The largest holes tell mostly, by their rounded extents.
bool all_filled(const Lattice& lattice, const Operand& holed, const Operand& other) {
  if (holed.loops.size() == 1) return true;
  const Component &c = holed.components[0], &d = other.components[0];
  const PlacedPoints &a = *lattice.points[holed.op], &b = *lattice.points[other.op];
  const double error = kExtents * (a.width + a.height + b.width + b.height);
  const Loop &widest = holed.loops[c.widest_hole], &tallest = holed.loops[c.tallest_hole], &outer = other.loops[0];
  if (a.x[widest.max_x] - a.x[widest.min_x] < b.x[outer.max_x] - b.x[outer.min_x] - error) return true;
  if (a.y[tallest.max_y] - a.y[tallest.min_y] < b.y[outer.max_y] - b.y[outer.min_y] - error) return true;
  for (std::size_t l = 1; l < holed.loops.size(); ++l)
    if (!hole_is_filled(lattice, holed, holed.loops[l], other, d)) return false;
  return true;
}

}  // namespace

std::optional<SumRing> convex_boundary(const Lattice& lattice, const Operand& p, const Operand& q) {
  for (const Operand* o : {&p, &q})
    if (o->components.size() != 1 || !o->components[0].convex) return std::nullopt;
  if (!all_filled(lattice, p, q) || !all_filled(lattice, q, p)) return std::nullopt;
  const DirectionList& of_p = p.directions[p.component_directions[0][1]];
  const DirectionList& of_q = q.directions[q.component_directions[0][1]];
  const std::size_t n = of_p.edges.size(), m = of_q.edges.size();
  // The next edges of P and Q start at vertices i and j.
  std::uint32_t i = of_p.edges[0], j = of_q.edges[0];
  const auto edge_of_p = [&] { return contact_of({0, i, j}, p, q); };
  const auto edge_of_q = [&] { return contact_of({1, j, i}, p, q); };
  SumRing ring;
  ring.vertices.reserve(n + m);
  Contact last;
  for (std::size_t a = 0, b = 0; a < n || b < m;) {
    const int order = a == n   ? 1
                      : b == m ? -1
                               : compare_directions(lattice, of_p.keys[a], p.edge(i), of_q.keys[b], q.edge(j));
    SumVertex& v = ring.vertices.emplace_back();
    v.in = last;
    v.out = order <= 0 ? edge_of_p() : edge_of_q();
    v.corner_p = p.vertex_index[i];
    v.corner_q = q.vertex_index[j];
    v.at = lattice.to_input(p.x[i] + q.x[j], p.y[i] + q.y[j]);
    last = v.out;
    if (order <= 0) {
      i = p.next[i];
      ++a;
    }
    // Parallel edges run on in one another: the turns are half-open at opposite ends, so P's comes first.
    if (order == 0) last = edge_of_q();
    if (order >= 0) {
      j = q.next[j];
      ++b;
    }
  }
  ring.vertices.front().in = last;
  return ring;
}

}  // namespace dymsum::planar
