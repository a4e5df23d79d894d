// Erosion and sum one after the other.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/hypot3.h"
#include "dymsum/solid_erosion.h"
#include "exact/orient3.h"
#include "spatial/erode/erosion.h"
#include "spatial/sum/face_triangles.h"
#include "spatial/sum/rounded_surface.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/touching_vertices.h"

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

/// A result as an operand of the next operation; faces of what is tight are thin.
struct Step {
  MeshData set;
  std::vector<bool> thin;  ///< empty where nothing is
  double moved = 0;
};

/// Each vertex to the nearest doubles.
Result<Step> rounded_vertices(const SpatialSum& sum, BetweenSteps between) {
  Step step;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    double at[3], by[3];
    bool moved = false;
    const spatial::ExactPosition exact = spatial::SpatialSumInternals::positions(sum).at(v);
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = exact::round_to_double(exact[axis]);
      if (!std::isfinite(at[axis]))
        return error_at(ErrorCode::not_finite, "a vertex between the steps is beyond the doubles", sum.vertices[v]);
      const BigRational gap = exact[axis] - exact::exact_value(at[axis]);
      moved = moved || !gap.is_zero();
      by[axis] = exact::round_to_double(gap);
    }
    step.set.vertices.push_back({at[0], at[1], at[2]});
    if (!moved) continue;
    if (between == BetweenSteps::exact)
      return error_at(ErrorCode::rounding_changed_topology,
                      "a vertex between the two operations has no doubles for coordinates", step.set.vertices[v]);
    // Gaps below the least double vanish.
    step.moved = std::max(step.moved, base::hypot3(by[0], by[1], by[2]) * (1 + 0x1p-50) + 0x1p-1072);
  }
  return step;
}

/// What is tight, as points, segments and triangles, of which rounding may leave less.
Result<void> add_tight(const SpatialSum& sum, Step& step) {
  if (sum.tight_faces.empty() && sum.tight_segments.empty() && sum.tight_points.empty()) return {};
  step.thin.assign(step.set.faces.size(), false);
  const std::vector<Point3>& at = step.set.vertices;
  for (const std::uint32_t v : sum.tight_points) step.set.faces.push_back({v});
  for (const auto& [from, to] : sum.tight_segments) step.set.faces.push_back({from, to});
  for (const std::array<std::uint32_t, 3>& t : sum.tight_triangles()) step.set.faces.push_back({t[0], t[1], t[2]});
  step.thin.resize(step.set.faces.size(), true);
  for (std::size_t f = 0; f < step.set.faces.size() && step.moved > 0; ++f) {
    const Face& face = step.set.faces[f];
    if (!step.thin[f] || face.size() < 2) continue;
    if (face.size() == 2 ? at[face[0]] != at[face[1]] : !exact::collinear(at[face[0]], at[face[1]], at[face[2]]))
      continue;
    return error_at(ErrorCode::rounding_changed_topology,
                    "rounding leaves less of a tight feature between the two operations", at[face[0]]);
  }
  return {};
}

/// Of a sum that is not needed any more.
Result<Step> next_operand(Result<SpatialSum> first, BetweenSteps between) {
  if (!first) return first.error();
  const SpatialSum& sum = *first;
  Result<Step> made = rounded_vertices(sum, between);
  if (!made) return made;
  Step step = *std::move(made);
  spatial::Triangles all = spatial::triangulated(sum);
  if (step.moved > 0) {
    if (std::optional<Error> error = spatial::rounding_error(sum.drawn().mesh)) {
      if (!sum.tight_faces.empty() || !sum.tight_segments.empty() || !sum.tight_points.empty())
        return *std::move(error);
      Result<SpatialSum::Rounded> merged = sum.rounded();
      if (!merged) return merged.error();
      step.moved = std::max(step.moved, merged->distance);
      step.set = std::move(merged)->mesh;
      return step;
    }
    all = spatial::split_at_touching_vertices(sum, std::move(all));
  }
  for (const spatial::Triangle& t : all.triangles) step.set.faces.push_back({t[0], t[1], t[2]});
  if (const Result<void> added = add_tight(sum, step); !added) return added.error();
  return step;
}

SolidOpening with(SpatialSum solid, double moved) { return {std::move(solid), moved}; }

}  // namespace

Result<SolidOpening> opening(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  SpatialOptions inside = options;
  inside.tight = true;  // where b fits without room to move, it covers what no other position does
  inside.trace = false;
  const Result<Step> step = next_operand(erode(a, b, inside), between);
  if (!step) return step.error();
  Result<SpatialSum> sum = spatial::sum_of_operands(spatial::solid_operand(step->set, step->thin),
                                                    spatial::solid_operand(b.data()), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

Result<SolidOpening> closing(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  if (a.has_thin_parts() || b.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  SpatialOptions regular = options;
  regular.tight = false;  // the closed sum holds its tight features
  regular.trace = false;
  const Result<Step> step = next_operand(minkowski_sum(a, b, regular), between);
  if (!step) return step.error();
  Result<SpatialSum> sum = spatial::erosion(step->set, b.data(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

}  // namespace dymsum
