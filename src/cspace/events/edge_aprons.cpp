#include "cspace/events/edge_aprons.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

/// Lengths in depths: how far from an edge nothing else may come, how near to an end a corner counts, and beyond one.
constexpr double kClear = 16, kCorner = 4, kBeyond = 2;
/// Twice as long, and corners apart.
constexpr double kLeastLength = 2 * kClear;

}  // namespace

EdgeAprons::Beside EdgeAprons::beside(std::uint32_t op, std::uint32_t edge, double along, double left) {
  std::uint8_t& known = clear_[op][edge];
  if (known == kUnknown) known = clear(op, edge) ? 1 : 0;
  if (known == 0 || !(std::abs(left) <= depth_)) return Beside::no;
  const Operand& o = forms_.operand(op);
  const Point d = forms_.edge(op, edge);
  const double length = std::hypot(d.x, d.y);
  if (!(along >= -kBeyond * depth_ && along <= length + kBeyond * depth_)) return Beside::no;
  // At a reflex corner the interior is what is left of one of the two edges, at a convex one what is left of both.
  if (along < kCorner * depth_ && o.convex[edge] != 0) return Beside::prev;
  if (along > length - kCorner * depth_ && o.convex[o.next[edge]] != 0) return Beside::next;
  return Beside::edge;
}

// A convex corner that is not sharp leaves the edge faster than at a quarter of its distance from the corner.
bool EdgeAprons::blunt(std::uint32_t op, std::uint32_t edge, std::uint32_t next) const {
  const Point d = forms_.edge(op, edge), e = forms_.edge(op, next);
  const double cross = d.x * e.y - d.y * e.x, dot = d.x * e.x + d.y * e.y;
  return dot >= 0 || std::abs(cross) >= 0.5 * std::hypot(d.x, d.y) * std::hypot(e.x, e.y);
}

// No other edge meets the rectangle around this one: it lies beyond one of its sides, or the rectangle beside its line.
bool EdgeAprons::clear(std::uint32_t op, std::uint32_t edge) const {
  const Operand& o = forms_.operand(op);
  if (o.components[o.component_of[edge]].dimension != 2 || forms_.is_point(op, edge)) return false;
  const std::uint32_t before = o.prev[edge], after = o.next[edge];
  if (!blunt(op, before, edge) || !blunt(op, edge, after)) return false;
  const std::vector<Point>& at = forms_.points(op);
  const Point a = at[edge], e = forms_.edge(op, edge);
  const double length = std::hypot(e.x, e.y), wide = kClear * depth_;
  if (!(length >= kLeastLength * depth_)) return false;
  const Point u{e.x / length, e.y / length};
  const auto seen = [&](Point p) {
    return Point{u.x * (p.x - a.x) + u.y * (p.y - a.y), u.x * (p.y - a.y) - u.y * (p.x - a.x)};
  };
  for (std::uint32_t f = 0; f < forms_.size(op); ++f) {
    if (f == edge || f == before || f == after) continue;
    const Point p = seen(at[f]), q = seen(at[o.next[f]]);
    if (std::max(p.x, q.x) < -wide || std::min(p.x, q.x) > length + wide || std::max(p.y, q.y) < -wide ||
        std::min(p.y, q.y) > wide)
      continue;
    const auto side = [&](double x, double y) { return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x); };
    const auto [least, most] =
        std::minmax({side(-wide, -wide), side(length + wide, -wide), side(length + wide, wide), side(-wide, wide)});
    const double margin = 0.01 * wide * std::hypot(q.x - p.x, q.y - p.y);
    if (!(least > margin || most < -margin)) return false;
  }
  return true;
}

}  // namespace dymsum::planar
