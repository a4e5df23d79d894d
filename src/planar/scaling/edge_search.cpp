#include "planar/scaling/edge_search.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

// Pairs of tree nodes. Where operands overlap some edges that cross are soon found; where they do not, all would have to be looked at.
constexpr std::uint32_t kMostLooks = 128;

}  // namespace

// Whether the ends of an edge of the other operand lie on opposite sides of an edge, certainly.
inline bool EdgeSearch::opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge, const Place& at) const {
  const Operand &o = window_.base().operands[op], &other = window_.base().operands[1 - op];
  const double own = op == window_.frame().moving ? at.tau : 1, others = op == window_.frame().moving ? 1 : at.tau;
  const double ex = o.ex[edge], ey = o.ey[edge], bound = (std::abs(ex) + std::abs(ey)) * (at.error + 0x1p-48 * window_.span());
  const double px = own * o.x[edge], py = own * o.y[edge];
  const auto value = [&](std::uint32_t v) { return ex * (at.y - (py + others * other.y[v])) - ey * (at.x - (px + others * other.x[v])); };
  const double u = value(other_edge), v = value(other.next[other_edge]);
  return (u > bound && v < -bound) || (u < -bound && v > bound);
}

bool EdgeSearch::cross(const CrossingEdges& edges, const Place& at) const {
  return opposite(0, edges[0], edges[1], at) && opposite(1, edges[1], edges[0], at);
}

void EdgeSearch::remember(const CrossingEdges& edges) {
  known_ = std::min(known_ + 1, lately_.size());
  std::rotate(lately_.begin(), lately_.end() - 1, lately_.end());
  lately_[0] = edges;
}

std::optional<CrossingEdges> EdgeSearch::find(const Place& at) {
  for (std::size_t k = 0; k < known_; ++k)
    if (cross(lately_[k], at)) {
      const auto hit = lately_.begin() + static_cast<std::ptrdiff_t>(k);
      std::rotate(lately_.begin(), hit, hit + 1);
      return lately_[0];
    }
  for (const EdgeTree& p : window_.base().operands[0].trees)
    for (const EdgeTree& q : window_.base().operands[1].trees)
      if (const auto edges = find_in(p, q, at)) {
        remember(*edges);
        return edges;
      }
  return std::nullopt;
}

std::optional<CrossingEdges> EdgeSearch::find_in(const EdgeTree& p, const EdgeTree& q, const Place& at) {
  const double of_p = window_.frame().moving == 0 ? at.tau : 1, of_q = window_.frame().moving == 1 ? at.tau : 1;
  const auto apart = [&](const auto& a, const auto& b) {
    return of_p * a.x0 + of_q * b.x0 > at.x || of_p * a.x1 + of_q * b.x1 < at.x || of_p * a.y0 + of_q * b.y0 > at.y || of_p * a.y1 + of_q * b.y1 < at.y;
  };
  stack_.assign(1, {0, 0});
  for (std::uint32_t looked = 0; !stack_.empty() && looked < kMostLooks; ++looked) {
    const auto [i, j] = stack_.back();
    stack_.pop_back();
    const EdgeTree::Node &a = p.nodes[i], &b = q.nodes[j];
    if (apart(a, b)) continue;
    if (a.left == 0 && b.left == 0) {
      for (std::uint32_t e = a.first; e < a.last; ++e) {
        const EdgeBox& u = window_.base().operands[0].boxes[e];
        // Where an edge of Q has to reach, seen from e.
        const double x0 = at.x - of_p * std::max(u.ax, u.bx), x1 = at.x - of_p * std::min(u.ax, u.bx);
        const double y0 = at.y - of_p * std::max(u.ay, u.by), y1 = at.y - of_p * std::min(u.ay, u.by);
        if (of_q * b.x1 < x0 || of_q * b.x0 > x1 || of_q * b.y1 < y0 || of_q * b.y0 > y1) continue;
        for (std::uint32_t f = b.first; f < b.last; ++f) {
          const EdgeBox& v = window_.base().operands[1].boxes[f];
          const bool apart_x = of_q * std::max(v.ax, v.bx) < x0 || of_q * std::min(v.ax, v.bx) > x1;
          const bool apart_y = of_q * std::max(v.ay, v.by) < y0 || of_q * std::min(v.ay, v.by) > y1;
          if (!apart_x && !apart_y && cross({e, f}, at)) return CrossingEdges{e, f};
        }
      }
    } else if (b.left == 0 || (a.left != 0 && a.last - a.first >= b.last - b.first)) {
      stack_.push_back({a.left, j});
      stack_.push_back({a.right, j});
    } else {
      stack_.push_back({i, b.left});
      stack_.push_back({i, b.right});
    }
  }
  return std::nullopt;
}

}  // namespace dymsum::planar
