#include "spatial/mesh/equal_positions.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace dymsum::spatial {

std::vector<std::uint32_t> order_by_position(const std::vector<Point3>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(points[a].x, points[a].y, points[a].z, a) < std::tie(points[b].x, points[b].y, points[b].z, b);
  });
  return order;
}

std::vector<std::uint32_t> first_at_position(const std::vector<Point3>& points) {
  const std::vector<std::uint32_t> order = order_by_position(points);
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

}  // namespace dymsum::spatial
