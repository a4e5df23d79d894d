#include "spatial/mesh/grid_positions.h"

#include <algorithm>
#include <cmath>

#include "exact/grid.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum::spatial {

using exact::Big;

GridPositions grid_positions(std::span<const Point3> points) {
  GridPositions p;
  std::vector<double> all;
  all.reserve(3 * points.size());
  double most = 0;
  for (const Point3& v : points)
    for (const double c : {v.x, v.y, v.z}) {
      all.push_back(c);
      most = std::max(most, std::abs(c));
    }
  p.exponent = exact::common_exponent(all);
  p.bits = exact::bits_needed(most, p.exponent);
  if (p.bits <= 61) {
    const auto on = [&](double c) { return exact::grid_coordinate<exact::Int<61>>(c, p.exponent).raw(); };
    for (const Point3& v : points) p.grid.push_back({on(v.x), on(v.y), on(v.z)});
  } else {
    const auto on = [&](double c) { return exact::grid_coordinate<Big>(c, p.exponent); };
    for (const Point3& v : points) p.big.push_back({on(v.x), on(v.y), on(v.z)});
  }
  return p;
}

GridPositions grid_positions(const std::vector<exact::Vector3<Big>>& points, int exponent) {
  GridPositions p;
  p.exponent = exponent;
  for (const exact::Vector3<Big>& v : points) p.bits = std::max(p.bits, bit_length(v));
  if (p.bits > 61) {
    p.big = points;
    return p;
  }
  const auto on = [](const Big& c) { return static_cast<std::int64_t>(c.value()); };
  for (const exact::Vector3<Big>& v : points) p.grid.push_back({on(v.x), on(v.y), on(v.z)});
  return p;
}

}  // namespace dymsum::spatial
