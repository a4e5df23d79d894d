#include "planar/window/edge_search.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

// Pairs of tree nodes. Where operands overlap some edges that cross are soon found; where they do not, all would have
// to be looked at.
constexpr std::uint32_t kMostLooks = 128;
// After so many searches in vain only one of so many is made.
constexpr std::uint32_t kInVain = 4, kSpared = 4;

}  // namespace

// Whether the ends of an edge of the other operand lie on opposite sides of an edge, provably. Which end lies on which
// side is the same at both positions: edges keep their directions.
inline bool EdgeSearch::opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge,
                                 const PositionPair& at) const {
  const Operand &o = window_.base().operands[op], &other = window_.base().operands[1 - op];
  const Two own = scale(op, at), others = scale(1 - op, at), ex = both(o.ex[edge]), ey = both(o.ey[edge]);
  const Two bound = both(std::abs(o.ex[edge]) + std::abs(o.ey[edge])) * (at.error + both(kSearchSide * window_.span()));
  const Two px = own * both(o.x[edge]), py = own * both(o.y[edge]);
  const auto value = [&](std::uint32_t v) {
    return ex * (at.y - (py + others * both(other.y[v]))) - ey * (at.x - (px + others * both(other.x[v])));
  };
  const Two u = value(other_edge), v = value(other.next[other_edge]);
  return (every(u > bound) && every(v < -bound)) || (every(u < -bound) && every(v > bound));
}

bool EdgeSearch::cross(const CrossingEdges& edges, const PositionPair& at) const {
  return opposite(0, edges[0], edges[1], at) && opposite(1, edges[1], edges[0], at);
}

std::optional<CrossingEdges> EdgeSearch::find_or_spare(const Position& from, const Position& to) {
  const PositionPair at(from, to);
  if (const std::optional<CrossingEdges> known = find_recent(at)) return known;
  if (in_vain_ >= kInVain && ++in_vain_ < kInVain + kSpared) return std::nullopt;
  const std::optional<CrossingEdges> edges = find_new(at);
  in_vain_ = edges ? 0 : std::min(in_vain_ + 1, kInVain);
  return edges;
}

std::optional<CrossingEdges> EdgeSearch::find_new(const PositionPair& at) {
  for (const EdgeTree& p : window_.base().operands[0].trees())
    for (const EdgeTree& q : window_.base().operands[1].trees())
      if (const auto edges = find_in(p, q, at)) {
        remember(*edges);
        return edges;
      }
  return std::nullopt;
}

std::optional<CrossingEdges> EdgeSearch::find_in(const EdgeTree& p, const EdgeTree& q, const PositionPair& at) {
  const Two of_p = scale(0, at), of_q = scale(1, at);
  // The sum of two boxes does not hold one of the positions.
  const auto outside = [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    return any(of_p * both(a.x0) + of_q * both(b.x0) > at.x) | any(of_p * both(a.x1) + of_q * both(b.x1) < at.x) |
           any(of_p * both(a.y0) + of_q * both(b.y0) > at.y) | any(of_p * both(a.y1) + of_q * both(b.y1) < at.y);
  };
  std::uint32_t looked = 0;
  const auto apart = [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    return looked++ >= kMostLooks || outside(a, b);
  };
  std::optional<CrossingEdges> found;
  any_pair_of_leaves(p.nodes, 0, q.nodes, 0, apart, [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    found = find_in_leaves(a, b, at);
    return found.has_value();
  });
  return found;
}

std::optional<CrossingEdges> EdgeSearch::find_in_leaves(const EdgeTree::Node& a, const EdgeTree::Node& b,
                                                        const PositionPair& at) const {
  const double of_p = scale(0, at)[0], of_q = scale(1, at)[0];
  for (std::uint32_t e = a.first; e < a.last; ++e) {
    const EdgeBox& u = window_.base().operands[0].boxes[e];
    // The box that an edge of Q has to reach, seen from e.
    const double x0 = at.x[0] - of_p * std::max(u.ax, u.bx), x1 = at.x[0] - of_p * std::min(u.ax, u.bx);
    const double y0 = at.y[0] - of_p * std::max(u.ay, u.by), y1 = at.y[0] - of_p * std::min(u.ay, u.by);
    if (of_q * b.x1 < x0 || of_q * b.x0 > x1 || of_q * b.y1 < y0 || of_q * b.y0 > y1) continue;
    for (std::uint32_t f = b.first; f < b.last; ++f) {
      const EdgeBox& v = window_.base().operands[1].boxes[f];
      const bool apart_x = of_q * std::max(v.ax, v.bx) < x0 || of_q * std::min(v.ax, v.bx) > x1;
      const bool apart_y = of_q * std::max(v.ay, v.by) < y0 || of_q * std::min(v.ay, v.by) > y1;
      if (!apart_x && !apart_y && cross({e, f}, at)) return CrossingEdges{e, f};
    }
  }
  return std::nullopt;
}

}  // namespace dymsum::planar
