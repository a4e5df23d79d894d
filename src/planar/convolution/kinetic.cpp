#include "planar/convolution/kinetic.h"

#include <algorithm>
#include <array>

namespace dymsum::planar {
namespace {

std::vector<std::uint32_t> edges_by_direction(const Lattice& lattice, const Operand& o, const Component& c,
                                              const std::vector<std::uint8_t>& filled) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
    const Loop& loop = o.loops[l];
    if (loop.kind == LoopKind::point || filled[l - c.first_loop]) continue;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) edges.push_back(i);
  }
  std::sort(edges.begin(), edges.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int order = compare_directions(lattice, o.edge(a), o.edge(b));
    return order != 0 ? order < 0 : a < b;
  });
  return edges;
}

// The number of edges whose direction is less than that of d, or not greater (`equal_too`).
std::uint32_t count_below(const Lattice& lattice, const Operand& o, const std::vector<std::uint32_t>& edges,
                          const Edge& d, bool equal_too) {
  const auto at = std::partition_point(edges.begin(), edges.end(), [&](std::uint32_t e) {
    const int order = compare_directions(lattice, o.edge(e), d);
    return order < 0 || (equal_too && order == 0);
  });
  return static_cast<std::uint32_t>(at - edges.begin());
}

// The turns of the vertices of component c of operand o against the edges of a component of the other operand.
void component_turns(const Lattice& lattice, const Operand& o, const Component& c,
                     const std::vector<std::uint8_t>& filled, const Operand& other,
                     const std::vector<std::uint32_t>& edges, const std::function<void(const KineticTurn&)>& f) {
  const std::uint32_t n = static_cast<std::uint32_t>(edges.size());
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
    const Loop& loop = o.loops[l];
    if (n == 0 || filled[l - c.first_loop]) continue;
    for (std::uint32_t v = loop.first; v < loop.last; ++v) {
      KineticTurn t{other.op, v, &edges, 0, n, 1};
      if (loop.kind != LoopKind::point) {
        Edge from = o.edge(o.prev[v]), to = o.edge(v);
        t.sign = o.convex[v] ? 1 : -1;
        const int order = compare_directions(lattice, from, to);
        if (order == 0) continue;  // straight on, where rings touch: no turn
        if (t.sign < 0) std::swap(from, to);
        // Operand 1 is the one that is turned: an edge of P parallel to the edge in of Q is not met, one parallel to
        // out is.
        t.lo = count_below(lattice, other, edges, from, o.op == 1);
        const std::uint32_t hi = count_below(lattice, other, edges, to, o.op == 1);
        t.count = order * t.sign < 0 ? hi - t.lo : hi + n - t.lo;
        if (t.lo == n) t.lo = 0;
      }
      f(t);
    }
  }
}

}  // namespace

void for_each_kinetic_turn(const Lattice& lattice, const Operand& p, const Operand& q,
                           const std::function<void(const KineticTurn&)>& f) {
  const std::array<const Operand*, 2> operands{&p, &q};
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension < 2 && cq.dimension < 2) continue;
      const std::array<const Component*, 2> c{&cp, &cq};
      std::array<std::vector<std::uint8_t>, 2> filled;
      std::array<std::vector<std::uint32_t>, 2> edges;
      for (std::uint32_t op = 0; op < 2; ++op) {
        const Operand& o = *operands[op];
        filled[op].assign(c[op]->last_loop - c[op]->first_loop, 0);
        for (std::uint32_t l = c[op]->first_loop + 1; l < c[op]->last_loop; ++l)
          filled[op][l - c[op]->first_loop] = hole_is_filled(lattice, o, o.loops[l], *operands[1 - op], *c[1 - op]);
        edges[op] = edges_by_direction(lattice, o, *c[op], filled[op]);
      }
      for (std::uint32_t op = 0; op < 2; ++op)
        component_turns(lattice, *operands[op], *c[op], filled[op], *operands[1 - op], edges[1 - op], f);
    }
}

std::vector<KineticSegment> kinetic_convolution(const Lattice& lattice, const Operand& p, const Operand& q) {
  std::vector<KineticSegment> segments;
  for_each_kinetic_turn(lattice, p, q, [&](const KineticTurn& t) {
    const std::uint32_t n = static_cast<std::uint32_t>(t.edges->size());
    for (std::uint32_t k = 0, at = t.lo; k < t.count; ++k, at = at + 1 == n ? 0 : at + 1)
      segments.push_back({{t.side, (*t.edges)[at], t.vertex}, t.sign});
  });
  return segments;
}

}  // namespace dymsum::planar
