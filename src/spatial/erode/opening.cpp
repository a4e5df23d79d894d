// Erosion and sum one after the other.
#include <algorithm>
#include <cmath>
#include <optional>

#include "dymsum/solid_erosion.h"
#include "spatial/erode/erosion.h"
#include "spatial/sum/face_triangles.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {

namespace {
constexpr const char* kThin = "inner fits, openings and closings are of solids without thin parts";
}

Result<SpatialSum> erode(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  if (a.has_thin_parts() || b.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  return spatial::erosion(a.data(), b.data(), options);
}

namespace {

using exact::BigRational;

Error error_at(ErrorCode code, const char* message, const Point3& at) {
  Error error{code, message, {}};
  error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
  return error;
}

std::optional<Point3> first_tight(const SpatialSum& sum) {
  if (!sum.tight_faces.empty()) return sum.vertices[sum.tight_faces[0][0][0]];
  if (!sum.tight_segments.empty()) return sum.vertices[sum.tight_segments[0][0]];
  if (!sum.tight_points.empty()) return sum.vertices[sum.tight_points[0]];
  return std::nullopt;
}

/// A result as an operand of the next operation.
struct Step {
  MeshData solid;
  double moved = 0;
};

Result<Step> next_operand(const SpatialSum& sum, BetweenSteps between) {
  Step step;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    double at[3], square = 0;
    bool moved = false;
    const spatial::ExactPosition exact = spatial::SpatialSumInternals::positions(sum).at(v);
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = exact::round_to_double(exact[axis]);
      if (!std::isfinite(at[axis]))
        return error_at(ErrorCode::not_finite, "a vertex between the steps is beyond the doubles", sum.vertices[v]);
      const BigRational gap = exact[axis] - exact::exact_value(at[axis]);
      moved = moved || !gap.is_zero();
      const double distance = exact::round_to_double(gap);
      square += distance * distance;
    }
    step.solid.vertices.push_back({at[0], at[1], at[2]});
    if (!moved) continue;
    if (between == BetweenSteps::exact)
      return error_at(ErrorCode::rounding_changed_topology,
                      "a vertex between the two operations has no doubles for coordinates", step.solid.vertices[v]);
    // The squares of tiny numbers vanish.
    step.moved = std::max(step.moved, std::sqrt(square) * (1 + 0x1p-50) + 0x1p-530);
  }
  if (step.moved > 0) {
    Result<SpatialSum::Rounded> rounded = sum.rounded();
    if (!rounded) return rounded.error();
    step.solid = std::move(*std::move(rounded)).mesh;
    return step;
  }
  for (const spatial::Triangle& t : spatial::triangulated(sum).triangles)
    step.solid.faces.push_back({t[0], t[1], t[2]});
  return step;
}

SolidOpening with(SpatialSum solid, double moved) { return {std::move(solid), moved}; }

}  // namespace

Result<SolidOpening> opening(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  const Result<SpatialSum> inner = erode(a, b, options);
  if (!inner) return inner.error();
  if (const std::optional<Point3> tight = first_tight(*inner))
    return error_at(
        ErrorCode::unsupported_operand,
        "the solid fits here without room to move; its sum with positions that have no volume is not supported",
        *tight);
  const Result<Step> step = next_operand(*inner, between);
  if (!step) return step.error();
  Result<SpatialSum> sum = spatial::sum_of_solids(step->solid, b.data(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

Result<SolidOpening> closing(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  if (a.has_thin_parts() || b.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  SpatialOptions regular = options;
  regular.tight = false;  // the closed sum holds its tight features
  const Result<SpatialSum> outer = minkowski_sum(a, b, regular);
  if (!outer) return outer.error();
  const Result<Step> step = next_operand(*outer, between);
  if (!step) return step.error();
  Result<SpatialSum> sum = spatial::erosion(step->solid, b.data(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

}  // namespace dymsum
