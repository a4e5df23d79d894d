#include "planar/edit/new_overlap.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

std::array<int, 2> NewOverlap::sides(const SegmentPosition& x, std::uint32_t op, std::uint32_t edge,
                                     std::uint32_t other_edge) const {
  const Operand &o = *operands_[op], &other = *operands_[1 - op];
  const double ex = o.ex[edge], ey = o.ey[edge], ax = x.x - o.x[edge], ay = x.y - o.y[edge];
  const double bound = (std::abs(ex) + std::abs(ey)) * (x.error + kSumSide * lattice_.span) + exact::kUnderflow;
  const auto side = [&](std::uint32_t v) {
    const double value = ex * (ay - other.y[v]) - ey * (ax - other.x[v]);
    return (value > bound) - (value < -bound);
  };
  return {side(other_edge), side(other.next[other_edge])};
}

bool NewOverlap::provably_cross(const SegmentPosition& x, const CrossingEdges& edges) const {
  const auto [a, b] = sides(x, 0, edges[0], edges[1]);
  if (a * b >= 0) return false;
  const auto [c, d] = sides(x, 1, edges[1], edges[0]);
  return c * d < 0;
}

// The edges of the other operand that the box of all new ones reaches at x.
std::vector<std::uint32_t> NewOverlap::near(const SegmentPosition& x, std::uint32_t op) const {
  const Operand &o = *operands_[op], &other = *operands_[1 - op];
  const double margin = x.error + kSumBox * lattice_.span;
  double low_x = INFINITY, low_y = INFINITY, high_x = -INFINITY, high_y = -INFINITY;
  for (const std::uint32_t e : fresh_[op]) {
    const EdgeBox& b = o.boxes[e];
    low_x = std::min({low_x, b.ax, b.bx}), high_x = std::max({high_x, b.ax, b.bx});
    low_y = std::min({low_y, b.ay, b.by}), high_y = std::max({high_y, b.ay, b.by});
  }
  std::vector<std::uint32_t> edges;
  for (std::uint32_t f = 0; f < other.size(); ++f) {
    const EdgeBox& c = other.boxes[f];
    if (std::max(c.ax, c.bx) >= x.x - high_x - margin && std::min(c.ax, c.bx) <= x.x - low_x + margin &&
        std::max(c.ay, c.by) >= x.y - high_y - margin && std::min(c.ay, c.by) <= x.y - low_y + margin)
      edges.push_back(f);
  }
  return edges;
}

bool NewOverlap::apart(const SegmentPosition& x, std::uint32_t op, std::uint32_t edge,
                       std::span<const std::uint32_t> others) const {
  const Operand &o = *operands_[op], &other = *operands_[1 - op];
  const double margin = x.error + kSumBox * lattice_.span;
  const EdgeBox& b = o.boxes[edge];
  const double x0 = x.x - std::max(b.ax, b.bx) - margin, x1 = x.x - std::min(b.ax, b.bx) + margin;
  const double y0 = x.y - std::max(b.ay, b.by) - margin, y1 = x.y - std::min(b.ay, b.by) + margin;
  for (const std::uint32_t f : others) {
    const EdgeBox& c = other.boxes[f];
    if (std::max(c.ax, c.bx) < x0 || std::min(c.ax, c.bx) > x1 || std::max(c.ay, c.by) < y0 ||
        std::min(c.ay, c.by) > y1)
      continue;
    const auto own = sides(x, op, edge, f), its = sides(x, 1 - op, f, edge);
    if (own[0] * own[1] <= 0 && its[0] * its[1] <= 0) return false;
  }
  return true;
}

bool NewOverlap::provably_none(const SegmentPosition& x) const {
  if (operands_[0]->components.size() != 1 || operands_[1]->components.size() != 1) return false;
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (fresh_[op].empty()) continue;
    const std::vector<std::uint32_t> others = near(x, op);
    for (const std::uint32_t e : fresh_[op])
      if (!apart(x, op, e, others)) return false;
  }
  return true;
}

}  // namespace dymsum::planar
