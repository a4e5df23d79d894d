#include "planar/convex_boundary.h"

#include <cstddef>

#include "planar/convolution.h"

namespace dymsum::planar {

std::optional<SumRing> convex_boundary(const Lattice& lattice, const Operand& p, const Operand& q) {
  for (const Operand* o : {&p, &q})
    if (o->components.size() != 1 || !o->components[0].convex) return std::nullopt;
  const Component &cp = p.components[0], &cq = q.components[0];
  if (!holes_are_filled(lattice, p, cp, q, cq) || !holes_are_filled(lattice, q, cq, p, cp)) return std::nullopt;
  const DirectionList& of_p = p.directions[p.component_directions[0][1]];
  const DirectionList& of_q = q.directions[q.component_directions[0][1]];
  const std::size_t n = of_p.edges.size(), m = of_q.edges.size();
  // The next edges of P and Q start at vertices i and j.
  std::uint32_t i = of_p.edges[0], j = of_q.edges[0];
  const auto edge_of_p = [&] { return Contact{Contact::Kind::edge_of_p, p.edge_number[i], q.vertex_number[j]}; };
  const auto edge_of_q = [&] { return Contact{Contact::Kind::edge_of_q, p.vertex_number[i], q.edge_number[j]}; };
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
    v.corner_p = p.vertex_number[i];
    v.corner_q = q.vertex_number[j];
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
