#include "check/extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"

namespace dymsum::check {
namespace {

constexpr int kDirections = 32;

/// Of length 1, but for some ulps.
const std::array<Point, kDirections>& directions() {
  static const std::array<Point, kDirections> all = [] {
    std::array<Point, kDirections> made;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * 3.141592653589793 * k / kDirections;
      made[static_cast<std::size_t>(k)] = {base::elementary::cos(angle), base::elementary::sin(angle)};
    }
    return made;
  }();
  return all;
}

}  // namespace

Extent::Extent(const EdgeTree& edges) {
  for (std::size_t k = 0; k < kDirections; ++k) {
    const Point u = directions()[k];
    double high = -std::numeric_limits<double>::infinity();
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (const PointRef& p : {edges[e].from, edges[e].to}) {
        high = std::max(high, u.x * p->near.x + u.y * p->near.y);
        reach_ = std::max({reach_, std::abs(p->near.x), std::abs(p->near.y)});
      }
    high_[k] = high;
  }
}

double depth_bound(const Extent& a, const Extent& b, const Interval& dx, const Interval& dy) {
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kDirections; ++k) {
    const Point u = directions()[k];
    const double opposite = b.high_[(k + kDirections / 2) % kDirections];
    bound = std::min(bound, a.high_[k] + opposite - (u.x * dx.midpoint() + u.y * dy.midpoint()));
  }
  // Sums of products that are off by some ulps of the coordinates.
  const double reach = a.reach_ + b.reach_ + std::max(std::abs(dx.low()), std::abs(dx.high())) +
                       std::max(std::abs(dy.low()), std::abs(dy.high()));
  return std::max(0.0, bound) * (1 + 0x1p-40) + 0x1p-40 * reach + 0x1p-1060;
}

}  // namespace dymsum::check
