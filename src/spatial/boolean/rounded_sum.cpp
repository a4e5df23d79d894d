// SpatialSum::rounded: nearest coordinates, else what is near merged, else what is left taken by winding numbers.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/doubles.h"
#include "dymsum/solid_union.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/sum/rounded_surface.h"
#include "spatial/sum/separated_surface.h"
#include "spatial/sum/surface_topology.h"

namespace dymsum {

namespace {

/// The largest difference of two numbers whose nearest doubles these are, rounded up.
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

/// No coordinate moves further when it is rounded.
double rounding_step(const MeshData& mesh, Precision precision) {
  double size = 0;
  for (const Point3& p : mesh.vertices) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return size * (precision == Precision::singles ? 0x1p-24 : 0x1p-53);
}

/// The solid that the triangles go around once their coordinates are rounded, exactly: what crosses then is cut there,
/// and slivers that are gone around twice or inside out are gone. Nothing where that is no solid.
std::optional<SpatialSum::Rounded> united_again(SpatialSum::Rounded drawn, Precision precision) {
  if (precision == Precision::singles)
    for (Point3& p : drawn.mesh.vertices) p = {base::in_single(p.x), base::in_single(p.y), base::in_single(p.z)};
  const Result<SpatialSum> solid = united(drawn.mesh);
  if (!solid || solid->faces.empty()) return std::nullopt;
  SpatialSum::Rounded result = solid->drawn();
  // A vertex of the sum that each is next to: a corner of the triangle that its face lies on.
  for (std::size_t t = 0; t < result.face.size(); ++t) {
    const std::uint32_t from = solid->faces[result.face[t]].p.a;
    for (const std::uint32_t v : result.mesh.faces[t]) result.vertex[v] = drawn.vertex[drawn.mesh.faces[from][0]];
    result.face[t] = drawn.face[from];
  }
  return result;
}

}  // namespace

Result<SpatialSum::Rounded> SpatialSum::rounded(Precision precision, double tolerance) const {
  const Rounded at_first = drawn();
  const bool single = precision == Precision::singles;
  if (!single && !spatial::rounding_error(at_first.mesh)) return at_first;
  if (tolerance == 0) tolerance = single ? 0x1p-20 : 0x1p-40;
  Result<Rounded> separated = spatial::separated_surface(at_first, precision, tolerance, untangled);
  if (separated && separated->nearest) return separated;
  // Rounds of merging. Alone it does not end where surfaces lie on each other but for rounding, as those of an opening
  // and of what was opened: then it is done once more, from the solid that the rounded surface goes around.
  constexpr int kRounds = 4;
  Rounded surface = at_first;
  double moved = 0;
  for (int k = 0; k < kRounds && !separated; ++k) {
    std::optional<Rounded> again = united_again(std::move(surface), precision);
    if (!again) return separated;
    surface = *std::move(again);
    moved += 2 * rounding_step(surface.mesh, precision);
    Result<Rounded> next = spatial::separated_surface(surface, precision, tolerance, untangled);
    if (next) separated = std::move(next);
  }
  if (!separated) return separated;
  Rounded made = *std::move(separated);
  made.distance += made.nearest ? moved + 2 * rounding_step(made.mesh, precision) : moved;
  made.nearest = false;
  made.lost_faces = spatial::lost_faces(at_first.face, made.face);
  made.volume_change = largest_difference(volume(), exact::round_to_double(spatial::exact_volume(made.mesh)));
  made.topology_kept = spatial::topology_of(made.mesh) == spatial::topology_of(at_first.mesh);
  return made;
}

}  // namespace dymsum
