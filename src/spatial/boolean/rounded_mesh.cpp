// Sums as meshes for further use, of doubles or of single-precision numbers; convex sums as hulls.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/doubles.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
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

}  // namespace dymsum
