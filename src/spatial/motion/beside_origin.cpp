#include "spatial/motion/beside_origin.h"

#include <utility>

#include "spatial/mesh/mesh_validate.h"

namespace dymsum::spatial {

namespace {

/// Coordinates from `low` to `high` are within a factor of 2 of the one that is returned, so their differences to it
/// are exact (Sterbenz).
double offset_along(double low, double high) {
  if (low > 0 && high <= 2 * low) return low;
  if (high < 0 && low >= 2 * high) return high;
  return 0;
}

}  // namespace

Point3 offset_from_origin(const Mesh& solid) {
  if (solid.empty()) return {};
  const auto [x_low, y_low, z_low, x_high, y_high, z_high] = bounds(solid);
  return {offset_along(x_low, x_high), offset_along(y_low, y_high), offset_along(z_low, z_high)};
}

std::optional<Mesh> beside_origin(const Mesh& solid) {
  const Point3 direction = offset_from_origin(solid);
  if (direction == Point3{}) return std::nullopt;
  MeshData moved = solid.data();
  for (Point3& v : moved.vertices) v = {v.x - direction.x, v.y - direction.y, v.z - direction.z};
  return trusted_mesh(std::move(moved), solid.shell_count());
}

}  // namespace dymsum::spatial
