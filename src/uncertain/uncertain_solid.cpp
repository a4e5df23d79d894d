// Pairs of solids: where they come from.
#include "dymsum/uncertain_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "dymsum/set_check.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "uncertain/steps_of_doubles.h"
#include "uncertain/uncertain_solid_internals.h"

namespace dymsum {
namespace {

Result<SpatialSum> as_solid_set(const Mesh& solid) { return united(std::span<const Mesh>(&solid, 1)); }

std::optional<Error> thin_error(const Mesh& solid) {
  if (!solid.has_thin_parts()) return std::nullopt;
  return Error{ErrorCode::unsupported_operand,
               "solids that are not known exactly have no points, segments and open surfaces: give what has volume",
               {}};
}

Result<UncertainSolid> solid_pair_of(Result<SpatialSum> inner, Result<SpatialSum> outer, double error = 0) {
  if (!inner) return inner.error();
  if (!outer) return outer.error();
  return UncertainSolidInternals::pair(*std::move(inner), *std::move(outer), error);
}

/// The offset by a deviation with a ball of facets on the side that is wanted.
Result<SpatialSum> offset_solid(const Mesh& nominal, double deviation, double within, OffsetBound bound) {
  if (deviation == 0 || nominal.empty()) return as_solid_set(nominal);
  Result<SolidOffset> made = offset(nominal, deviation, within, bound);
  if (!made) return made.error();
  return std::move(made->solid);
}

Error box_error(const std::string& message, std::size_t vertex) {
  Error error{ErrorCode::out_of_range, message, {}};
  error.evidence.vertex = static_cast<std::int64_t>(vertex);
  return error;
}

bool is_around(const std::array<double, 6>& box, const Point3& v) {
  const std::array<double, 3> at{v.x, v.y, v.z};
  for (std::size_t k = 0; k < 3; ++k)
    if (!(box[k] <= at[k] && at[k] <= box[k + 3]) || !std::isfinite(box[k + 3] - box[k])) return false;
  return true;
}

/// The hull of the boxes of a face's vertices; nothing where that is flat.
std::optional<Mesh> hull_of_boxes(const Face& face, std::span<const std::array<double, 6>> boxes) {
  MeshData corners;
  for (const std::uint32_t v : face)
    for (unsigned k = 0; k < 8; ++k)
      corners.vertices.push_back(
          {boxes[v][(k & 1) != 0 ? 3 : 0], boxes[v][(k & 2) != 0 ? 4 : 1], boxes[v][(k & 4) != 0 ? 5 : 2]});
  Result<HulledMesh> hull = hulled(corners);
  if (!hull) return std::nullopt;  // finite corners: they lie in one plane
  return std::move(hull->mesh);
}

}  // namespace

Result<UncertainSolid> UncertainSolid::known(const Mesh& solid) {
  if (std::optional<Error> error = thin_error(solid)) return *std::move(error);
  Result<SpatialSum> set = as_solid_set(solid);
  if (!set) return set.error();
  return UncertainSolidInternals::one(*std::move(set), {solid});
}

Result<UncertainSolid> UncertainSolid::between(const SpatialOperand& inner, const SpatialOperand& outer) {
  const Result<SolidSetCheck> check = check_set(outer, inner);
  if (!check) return check.error();
  if (!check->contained()) {
    Error error{ErrorCode::out_of_range, "the inner set does not lie in the outer one", {}};
    error.evidence.x = check->surplus.at.x.to_double();
    error.evidence.y = check->surplus.at.y.to_double();
    error.evidence.z = check->surplus.at.z.to_double();
    return error;
  }
  Result<SpatialSum> in = united(std::span<const SpatialOperand>(&inner, 1));
  if (check->contains()) {
    if (!in) return in.error();
    return UncertainSolidInternals::one(*std::move(in));
  }
  return solid_pair_of(std::move(in), united(std::span<const SpatialOperand>(&outer, 1)));
}

Result<UncertainSolid> UncertainSolid::of_variants(std::vector<Mesh> variants, const Progress& progress) {
  if (variants.empty()) return Error{ErrorCode::out_of_range, "there are no variants", {}};
  if (variants.size() == 1) return known(variants[0]);
  for (const Mesh& variant : variants)
    if (std::optional<Error> error = thin_error(variant)) return *std::move(error);
  SpatialOptions options;
  options.progress = progress;
  Result<SpatialSum> inner = intersection(variants, options), outer = united(variants, options);
  if (!inner) return inner.error();
  if (!outer) return outer.error();
  return UncertainSolidInternals::list(*std::move(inner), *std::move(outer), std::move(variants));
}

Result<UncertainSolid> UncertainSolid::of_band(const Mesh& nominal, const Tolerance& tolerance, double within) {
  const double upper = tolerance.upper, lower = tolerance.lower;
  if (!std::isfinite(upper) || !std::isfinite(lower) || !std::isfinite(within) || within < 0)
    return Error{ErrorCode::out_of_range, "deviations and what balls may reach further are finite numbers", {}};
  if (lower > upper) return Error{ErrorCode::out_of_range, "the lower deviation is larger than the upper one", {}};
  if (std::optional<Error> error = thin_error(nominal)) return *std::move(error);
  if (upper == 0 && lower == 0) return known(nominal);
  constexpr double kPart = 0x1p-4;
  const double largest = std::max(std::abs(upper), std::abs(lower)), further = within > 0 ? within : kPart * largest;
  return solid_pair_of(offset_solid(nominal, lower, further, OffsetBound::inside),
                       offset_solid(nominal, upper, further, OffsetBound::outside), further);
}

Result<UncertainSolid> UncertainSolid::of_boxes(const Mesh& nominal, std::span<const std::array<double, 6>> boxes,
                                                const Progress& progress) {
  if (std::optional<Error> error = thin_error(nominal)) return *std::move(error);
  const std::vector<Point3>& vertices = nominal.vertices();
  if (boxes.size() != vertices.size())
    return Error{
        ErrorCode::out_of_range,
        "there are " + std::to_string(boxes.size()) + " boxes for " + std::to_string(vertices.size()) + " vertices",
        {}};
  for (std::size_t k = 0; k < boxes.size(); ++k)
    if (!is_around(boxes[k], vertices[k])) return box_error("the box is not around its vertex", k);
  std::vector<Mesh> hulls;
  for (const Face& face : nominal.faces())
    if (std::optional<Mesh> hull = hull_of_boxes(face, boxes)) hulls.push_back(*std::move(hull));
  if (hulls.empty()) return known(nominal);
  SpatialOptions options;
  options.progress = progress;
  Result<SpatialSum> inner = difference(nominal, hulls, options);
  hulls.push_back(nominal);
  return solid_pair_of(std::move(inner), united(hulls, options));
}

// Where all boxes are one box B, at every vertex, the hulls of the faces' boxes are the faces (+) B: together with the
// solid its sum with B, and what they leave of it is the erosion by -B.
Result<UncertainSolid> UncertainSolid::of_rounding(const Mesh& nominal, std::int64_t ulps) {
  if (ulps < 0 || ulps > std::int64_t{1} << 40)
    return Error{
        ErrorCode::out_of_range, "units in the last place are from 0 to 2^40, not " + std::to_string(ulps), {}};
  if (ulps == 0 || nominal.empty()) return known(nominal);
  if (std::optional<Error> error = thin_error(nominal)) return *std::move(error);
  std::array<double, 3> reach{};
  for (std::size_t k = 0; k < nominal.vertices().size(); ++k) {
    const Point3& v = nominal.vertices()[k];
    const std::array<double, 3> at{v.x, v.y, v.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::int64_t steps : {-ulps, ulps}) {
        const double to = uncertain::steps_from(at[axis], steps);
        if (!std::isfinite(to)) return box_error("a coordinate may be infinite", k);
        const double away = uncertain::sum_outwards(to > at[axis] ? to : at[axis], to > at[axis] ? -at[axis] : -to);
        reach[axis] = std::max(reach[axis], std::nextafter(away, std::numeric_limits<double>::infinity()));
      }
  }
  const auto [x, y, z] = reach;
  const Mesh box = solids::box(-x, -y, -z, x, y, z);
  return solid_pair_of(erode(nominal, box), minkowski_sum(nominal, box));
}

bool UncertainSolid::exact() const { return inner_ == outer_ || *inner_ == *outer_; }

Result<SpatialSum> UncertainSolid::doubtful() const { return difference(outer(), inner()); }

}  // namespace dymsum
