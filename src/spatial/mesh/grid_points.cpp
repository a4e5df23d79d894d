#include "spatial/mesh/grid_points.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

SpaceGrid::Line grid_line(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const int exponent = exact::common_exponent(values);
  const double offset = exact::grid_center(*low, *high, exponent);
  return {exponent, offset, exact::bits_needed(*low, *high, offset, exponent)};
}

}  // namespace

exact::Tier SpaceGrid::tier() const { return exact::choose_tier(std::max({x.bits, y.bits, z.bits}), 0); }

SpaceGrid space_grid(const std::vector<Point3>& points) {
  std::vector<double> values(points.size());
  const auto line = [&](auto coordinate) {
    std::transform(points.begin(), points.end(), values.begin(), coordinate);
    return grid_line(values);
  };
  return {line([](const Point3& p) { return p.x; }), line([](const Point3& p) { return p.y; }),
          line([](const Point3& p) { return p.z; })};
}

}  // namespace dymsum::spatial
