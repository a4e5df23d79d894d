// Sums as meshes for further use, of doubles or of single-precision numbers; convex sums as hulls.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/doubles.h"
#include "dymsum/solid_union.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/sum/separated_surface.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/surface_edits.h"

namespace dymsum {

// Sums as meshes for further use, of doubles or of single-precision numbers; convex sums as hulls.

namespace {

std::string in_precision(Precision p) {
  return p == Precision::doubles ? "rounded to doubles, " : "rounded to single precision, ";
}

bool less(const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

Error at_vertex(ErrorCode code, std::string message, const SpatialSum& sum, std::uint32_t v) {
  Error error{code, std::move(message), {}};
  error.evidence.vertex = v;
  error.evidence.x = sum.vertices[v].x;
  error.evidence.y = sum.vertices[v].y;
  error.evidence.z = sum.vertices[v].z;
  return error;
}

/// The rounded positions, or the vertex that is past the range.
Result<std::vector<Point3>> rounded_positions(const SpatialSum& sum, Precision precision) {
  std::vector<Point3> at = sum.vertices;
  const spatial::SpatialPositions& positions = spatial::SpatialSumInternals::positions(sum);
  for (std::uint32_t v = 0; v < at.size(); ++v) {
    if (positions.scale != 1) at[v] = positions.rounded(v);  // what `vertices` has was divided after it was rounded
    for (double* c : {&at[v].x, &at[v].y, &at[v].z}) {
      if (precision == Precision::singles) *c = base::in_single(*c);
      if (!std::isfinite(*c))
        return at_vertex(ErrorCode::not_finite, in_precision(precision) + "a coordinate is past the range", sum, v);
    }
  }
  return at;
}

std::optional<Error> collision(const SpatialSum& sum, const std::vector<Point3>& at, Precision precision) {
  std::vector<std::uint32_t> order(at.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return less(at[a], at[b]); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (at[order[i - 1]] != at[order[i]]) continue;
    Error error = at_vertex(ErrorCode::rounding_changed_topology,
                            in_precision(precision) + "two vertices are at the same place", sum, order[i - 1]);
    error.evidence.other_vertex = order[i];
    return error;
  }
  return std::nullopt;
}

/// How far a vertex moved.
double moved(const SpatialSum& sum, std::uint32_t v, const Point3& to) {
  const RationalPoint3 from = sum.exact(v);
  const auto lost = [](const Rational& exact, double c) {
    return exact::round_to_double(exact::BigRational(exact::exact_value(exact) - exact::exact_value(c)));
  };
  return std::hypot(lost(from.x, to.x), lost(from.y, to.y), lost(from.z, to.z));
}

}  // namespace

Result<Mesh> SpatialSum::rounded_mesh(Precision precision) const {
  if (!is_convex()) {
    Result<Rounded> triangles = rounded(precision);
    if (!triangles) return triangles.error();
    return Mesh::create(std::move(*std::move(triangles)).mesh);
  }
  const Result<std::vector<Point3>> positions = rounded_positions(*this, precision);
  if (!positions) return positions.error();
  if (std::optional<Error> error = collision(*this, *positions, precision)) return *std::move(error);
  Result<Mesh> hull = convex_hull(*positions);
  const auto inside = [&](const std::vector<Point3>& corners) {
    for (std::uint32_t v = 0; v < positions->size(); ++v)
      if (!std::binary_search(corners.begin(), corners.end(), (*positions)[v], less)) return v;
    return static_cast<std::uint32_t>(positions->size());
  };
  if (hull && hull->vertices().size() == positions->size()) return hull;
  return at_vertex(ErrorCode::rounding_changed_topology, in_precision(precision) + "a vertex no longer sticks out",
                   *this, hull ? inside(hull->vertices()) : 0);
}

Result<HulledMesh> SpatialSum::rounded_hull(Precision precision) const {
  if (!is_convex()) return Error{ErrorCode::not_convex, "this sum was not made of convex solids", {}};
  const Result<std::vector<Point3>> positions = rounded_positions(*this, precision);
  if (!positions) return positions.error();
  Result<HulledMesh> hull = hulled({*positions, {}});
  if (!hull) return hull.error();
  HulledMesh result = std::move(hull).value();
  result.report.deviation = 0;
  for (std::uint32_t v = 0; v < positions->size(); ++v)
    result.report.deviation = std::max(result.report.deviation, moved(*this, v, (*positions)[v]));
  return result;
}

// SpatialSum::rounded: nearest coordinates, else what is near merged, else what is left taken by winding numbers.

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
  // Without a crossing, too, what is thin may be inside out then: around an edge of four faces, or a whole shell.
  if (!single && !spatial::rounding_error(at_first.mesh) && Mesh::create(at_first.mesh)) return at_first;
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
