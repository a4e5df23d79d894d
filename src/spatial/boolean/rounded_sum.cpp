// SpatialSum::rounded: nearest coordinates, else what is near merged, else what is left taken by winding numbers.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "dymsum/solid_union.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/sum/rounded_surface.h"
#include "spatial/sum/separated_surface.h"
#include "spatial/sum/surface_topology.h"

namespace dymsum {

namespace {

/// Of two numbers of which these are the nearest doubles, rounded up.
double largest_difference(double a, double b) {
  const auto ulp = [](double v) { return std::nextafter(std::abs(v), HUGE_VAL) - std::abs(v); };
  return std::nextafter(std::abs(a - b) + (ulp(a) + ulp(b)) / 2, HUGE_VAL);
}

using Position = std::tuple<double, double, double>;
Position position(const Point3& p) { return {p.x, p.y, p.z}; }

/// The solid that triangles go around which do not cross, but enclose slivers twice or inside out: by winding number.
/// Nothing where that needs new vertices.
std::optional<SpatialSum::Rounded> untangled(const SpatialSum::Rounded& made) {
  const Result<SpatialSum> solid = united(made.mesh);
  if (!solid) return std::nullopt;
  SpatialSum::Rounded result = solid->drawn();
  std::map<Position, std::uint32_t> vertex;
  for (std::size_t v = 0; v < made.mesh.vertices.size(); ++v)
    vertex.emplace(position(made.mesh.vertices[v]), made.vertex[v]);
  for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
    const auto known = vertex.find(position(result.mesh.vertices[v]));
    if (known == vertex.end()) return std::nullopt;
    result.vertex[v] = known->second;
  }
  for (std::uint32_t& face : result.face) face = made.face[solid->faces[face].p.a];
  result.nearest = false;
  result.merged_vertices = made.merged_vertices, result.collapsed_edges = made.collapsed_edges;
  result.bends = made.bends;
  result.distance = made.distance;
  return result;
}

}  // namespace

Result<SpatialSum::Rounded> SpatialSum::rounded(Precision precision, double tolerance) const {
  Rounded result = drawn();
  const bool single = precision == Precision::singles;
  if (!single && !spatial::rounding_error(result.mesh)) return result;
  if (tolerance == 0) tolerance = single ? 0x1p-20 : 0x1p-40;
  Result<Rounded> separated = spatial::separated_surface(result, precision, tolerance, untangled);
  if (!separated || separated->nearest) return separated;
  Rounded made = *std::move(separated);
  made.volume_change = largest_difference(volume(), exact::round_to_double(spatial::exact_volume(made.mesh)));
  made.topology_kept = spatial::topology_of(made.mesh) == spatial::topology_of(result.mesh);
  return made;
}

}  // namespace dymsum
