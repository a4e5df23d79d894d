#include "check/inner_discs.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "check/convex_cells.h"

namespace dymsum::check {

InnerDiscs::InnerDiscs(const PlanarSum& set, const EdgeTree& edges) {
  constexpr std::size_t kMost = 8;
  std::vector<Disc> all;
  for (const ConvexCell& cell : convex_cells(set)) {
    if (cell.vertices.size() < 3) continue;
    Point centre{0, 0};
    const auto n = static_cast<double>(cell.vertices.size());
    for (const PointRef& p : cell.vertices) centre = {centre.x + p->near.x / n, centre.y + p->near.y / n};
    // The centre is off by some ulps, as the distance is.
    const double radius = edges.rough_distance(centre) - 4 * edges.slack(edges, *cell.vertices[0]);
    if (radius > 0) all.push_back({centre, radius});
  }
  std::stable_sort(all.begin(), all.end(), [](const Disc& a, const Disc& b) { return a.radius > b.radius; });
  for (const Disc& d : all) {
    if (discs_.size() == kMost) break;
    const bool known = std::any_of(discs_.begin(), discs_.end(), [&](const Disc& e) {
      return std::hypot(d.centre.x - e.centre.x, d.centre.y - e.centre.y) < e.radius / 2;
    });
    if (!known) discs_.push_back(d);
  }
}

InnerDiscs InnerDiscs::turned(double radians) const {
  const double c = base::elementary::cos(radians), s = base::elementary::sin(radians);
  InnerDiscs made = *this;
  for (Disc& d : made.discs_) {
    d.radius -= 0x1p-40 * (std::abs(d.centre.x) + std::abs(d.centre.y));
    d.centre = {c * d.centre.x - s * d.centre.y, s * d.centre.x + c * d.centre.y};
  }
  std::erase_if(made.discs_, [](const Disc& d) { return !(d.radius > 0); });
  return made;
}

std::optional<Point> common_position(const InnerDiscs& a, const InnerDiscs& b, const Interval& dx, const Interval& dy) {
  for (const InnerDiscs::Disc& p : a.discs_)
    for (const InnerDiscs::Disc& q : b.discs_) {
      const Interval x = Interval(q.centre.x) + dx - Interval(p.centre.x),
                     y = Interval(q.centre.y) + dy - Interval(p.centre.y),
                     reach = Interval(p.radius) + Interval(q.radius);
      if (!((square(x) + square(y)).high() < square(reach).low())) continue;
      const double part = p.radius / (p.radius + q.radius);
      return Point{p.centre.x + part * x.midpoint(), p.centre.y + part * y.midpoint()};
    }
  return std::nullopt;
}

}  // namespace dymsum::check
