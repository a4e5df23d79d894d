// The crossings of the arcs of two Gauss maps, in lists along the arcs of both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// Arcs of an edge of P and an edge of Q that cross: the facet edge + edge of the sum.
struct Crossing {
  std::uint32_t p = 0;  ///< edge of P
  /// Half-edge of Q that leaves the vertex extreme before the crossing, going along p's arc from its left face.
  HalfEdge q = 0;
  /// The next crossing along the arc of the edge of P, of Q; kNoCrossing at its end.
  std::array<std::uint32_t, 2> next{};
};
constexpr std::uint32_t kNoCrossing = ~std::uint32_t{0};

/// A crossing seen from either operand: along the arc of this edge of operand op, from its left face to its right one,
/// ...
constexpr std::uint32_t edge_of(int op, const Crossing& c) { return op == 0 ? c.p : c.q / 2; }
/// ... this half-edge of the other operand leads from the vertex extreme before the crossing to the one extreme after
/// it.
constexpr HalfEdge across(int op, const Crossing& c) { return op == 0 ? c.q : 2 * c.p + (1 - (c.q & 1)); }
/// The crossing of edge e of operand op with `over` across it.
constexpr Crossing crossing_of(int op, std::uint32_t e, HalfEdge over) {
  return op == 0 ? Crossing{e, over, {}} : Crossing{over / 2, 2 * e + (1 - (over & 1)), {}};
}

/// The ends of certificates that hold for ever, or not at all.
constexpr double kForever = std::numeric_limits<double>::infinity(), kBeforeAll = -kForever;

/// Lists of crossings. A crossing keeps its index until it is freed; indices are used again.
struct ArcCrossings {
  std::vector<Crossing> all;
  std::vector<double> until;                        ///< of each index its certificate; kForever where it is free
  std::vector<std::uint32_t> free;                  ///< indices
  std::array<std::vector<std::uint32_t>, 2> head;   ///< of each edge of P, of Q, the first one along its arc
  std::vector<std::uint32_t> touched;               ///< arcs of one operand whose crossings have changed, each once
  std::array<std::vector<std::uint8_t>, 2> marked;  ///< of each edge of P, of Q: whether it is one of these

  ArcCrossings(const Polytope& p, const Polytope& q);

  Crossing& operator[](std::uint32_t id) { return all[id]; }
  const Crossing& operator[](std::uint32_t id) const { return all[id]; }
  std::size_t count() const { return all.size() - free.size(); }
  void clear();
  void touch(int op, std::uint32_t e) {
    if (marked[op][e]) return;
    marked[op][e] = 1;
    touched.push_back(e);
  }

  /// While crossings are found from nothing: of edge e of P and q, after the one before it along the arc of e, if any.
  std::uint32_t append(std::uint32_t e, HalfEdge q, double until_then, std::uint32_t before);
  /// A new one; it still has to be linked into the arc of the operand that is not op.
  std::uint32_t add(int op, const Crossing& crossing);
  /// Takes a crossing out of the list of the arc of operand op, to which it still belongs alone.
  void remove(int op, std::uint32_t id);

  /// Puts the crossings along the arc of edge e of operand op, which begins in the cell of vertex v of `other`, in
  /// order: each leaves the cell that the one before entered. The vertex in whose cell the arc ends.
  std::uint32_t order_along(int op, const Polytope& other, std::uint32_t e, std::uint32_t v);
  /// The same where its ends are not known, of an arc that is crossed: the vertices in whose cells it begins and ends.
  std::pair<std::uint32_t, std::uint32_t> ends_along(int op, const Polytope& other, std::uint32_t e);
};

}  // namespace dymsum::spatial
