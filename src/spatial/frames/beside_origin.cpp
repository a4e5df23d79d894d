#include "spatial/frames/beside_origin.h"

#include <utility>

#include "spatial/mesh/mesh_validate.h"

namespace dymsum::spatial {

namespace {

constexpr double kFar = 16;

/// Coordinates from `low` to `high` are within a factor of 2 of the one that is returned, so their differences to it
/// are exact (Sterbenz): were high > 2 low, the difference would be more than low, also rounded, and the bound is no
/// more than low however it is rounded below the normal range.
double way_along(double low, double high) {
  if (low > 0 && high - low <= low / kFar) return low;
  if (high < 0 && high - low <= -high / kFar) return high;
  return 0;
}

}  // namespace

Point3 way_from_origin(const Mesh& solid) {
  if (solid.empty()) return {};
  const auto [x_low, y_low, z_low, x_high, y_high, z_high] = bounds(solid);
  return {way_along(x_low, x_high), way_along(y_low, y_high), way_along(z_low, z_high)};
}

std::optional<Mesh> beside_origin(const Mesh& solid) {
  const Point3 way = way_from_origin(solid);
  if (way == Point3{}) return std::nullopt;
  MeshData moved = solid.data();
  for (Point3& v : moved.vertices) v = {v.x - way.x, v.y - way.y, v.z - way.z};
  return trusted_mesh(std::move(moved), solid.shell_count());
}

}  // namespace dymsum::spatial
