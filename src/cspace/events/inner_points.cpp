#include "cspace/events/inner_points.h"

#include <cmath>

namespace dymsum::planar {
namespace {

/// Positions so near to each other, as a fraction of the span, get one answer.
constexpr double kCell = 0x1p-14;

}  // namespace

InnerPoints::InnerPoints(const TurningForms& forms, const OverlapFilter& filter) : forms_(forms), filter_(filter) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    for (std::uint32_t e = 0; e < forms.size(op); ++e) {
      const std::uint32_t component = o.component_of[e];
      if (o.components[component].dimension != 2) continue;
      const Point a = forms.points(op)[e], b = forms.points(op)[o.next[e]], d{b.x - a.x, b.y - a.y};
      for (const double fraction : {0.25, 0.0625, 0.015625}) {
        const Point x{(a.x + b.x) / 2 - fraction * d.y, (a.y + b.y) / 2 + fraction * d.x};
        if (!filter.holds(op, component, x, Heading{}, fraction / 2 * std::hypot(d.x, d.y))) continue;
        points_[op].push_back(x);
        break;
      }
    }
  }
}

bool InnerPoints::inside(std::uint32_t op, std::size_t k, Point at, Heading h, double margin) const {
  const Point p = points_[op][k];
  const Point x =
      op == 0 ? Point{at.x - p.x, at.y - p.y} : Point{at.x - (h.c * p.x - h.s * p.y), at.y - (h.s * p.x + h.c * p.y)};
  const std::size_t components = forms_.operand(1 - op).components.size();
  for (std::uint32_t c = 0; c < components; ++c)
    if (forms_.operand(1 - op).components[c].dimension == 2 && filter_.holds(1 - op, c, x, h, margin)) return true;
  return false;
}

bool InnerPoints::inside(Point at, Heading h, double margin) {
  const double cell = kCell * forms_.span(), x = std::nearbyint(at.x / cell), y = std::nearbyint(at.y / cell);
  const auto [it, fresh] = known_.try_emplace({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y)}, false);
  if (fresh) it->second = find({x * cell, y * cell}, h, margin + cell);
  return it->second;
}

bool InnerPoints::find(Point at, Heading h, double margin) {
  for (const std::uint32_t op : {0U, 1U})
    if (last_[op] < points_[op].size() && inside(op, last_[op], at, h, margin)) return true;
  for (const std::uint32_t op : {1U, 0U})
    for (std::size_t k = 0; k < points_[op].size(); ++k)
      if (k != last_[op] && inside(op, k, at, h, margin)) {
        last_[op] = k;
        return true;
      }
  return false;
}

}  // namespace dymsum::planar
