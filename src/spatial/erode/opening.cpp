// Erosion and sum one after the other.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/doubles.h"
#include "dymsum/solid_erosion.h"
#include "exact/orient.h"
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

Result<SpatialSum> erode(const SpatialSum& a, const Mesh& b, const SpatialOptions& options) {
  if (b.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  if (const Result<Mesh> mesh = as_mesh(a)) return erode(*mesh, b, options);
  return spatial::erosion(spatial::exact_set(a), b.data(), options);
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
  spatial::ExactSet set;
  bool in_doubles = true;  ///< no vertex is a fraction
  double moved = 0;

  void round(const std::vector<Point3>& vertices, double by) {
    moved = std::max(moved, by);
    set = spatial::exact_set({vertices, std::move(set.set.faces)}, std::move(set.thin));
    in_doubles = true;
  }
};

/// The vertices, at the nearest doubles and exactly.
Result<Step> vertices_of(const SpatialSum& sum) {
  Step step;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    double at[3];
    step.set.at.push_back(spatial::SpatialSumInternals::positions(sum).at(v));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = exact::round_to_double(step.set.at[v][axis]);
      if (!std::isfinite(at[axis]))
        return error_at(ErrorCode::not_finite, "a vertex between the steps is beyond the doubles", sum.vertices[v]);
      step.in_doubles = step.in_doubles && exact::exact_value(at[axis]) == step.set.at[v][axis];
    }
    step.set.set.vertices.push_back({at[0], at[1], at[2]});
  }
  return step;
}

/// How far rounding moves a vertex, at most.
double largest_move(const spatial::ExactSet& set) {
  double most = 0;
  for (std::size_t v = 0; v < set.at.size(); ++v) {
    const Point3& at = set.set.vertices[v];
    double by[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      by[axis] = exact::round_to_double(BigRational(set.at[v][axis] - exact::exact_value(axis == 0   ? at.x
                                                                                         : axis == 1 ? at.y
                                                                                                     : at.z)));
    // Gaps below the least double vanish.
    most = std::max(most, base::hypot3(by[0], by[1], by[2]) * (1 + 0x1p-50) + 0x1p-1072);
  }
  return most;
}

/// What is tight, as points, segments and triangles.
void add_tight(const SpatialSum& sum, Step& step) {
  if (sum.tight_faces.empty() && sum.tight_segments.empty() && sum.tight_points.empty()) return;
  std::vector<Face>& faces = step.set.set.faces;
  step.set.thin.assign(faces.size(), false);
  for (const std::uint32_t v : sum.tight_points) faces.push_back({v});
  for (const auto& [from, to] : sum.tight_segments) faces.push_back({from, to});
  for (const std::array<std::uint32_t, 3>& t : sum.tight_triangles()) faces.push_back({t[0], t[1], t[2]});
  step.set.thin.resize(faces.size(), true);
}

/// The error where rounding leaves less of a tight feature.
Result<void> lost_tight(const Step& step) {
  const MeshData& set = step.set.set;
  const auto at = [&](std::uint32_t v) { return set.vertices[v]; };
  for (std::size_t f = 0; f < step.set.thin.size(); ++f) {
    const Face& face = set.faces[f];
    if (!step.set.thin[f] || face.size() < 2) continue;
    if (face.size() == 2 ? at(face[0]) != at(face[1]) : !exact::collinear(at(face[0]), at(face[1]), at(face[2])))
      continue;
    return error_at(ErrorCode::rounding_changed_topology,
                    "rounding leaves less of a tight feature between the two operations", at(face[0]));
  }
  return {};
}

/// The step with vertices at doubles; what crosses then is merged.
Result<Step> rounded_step(const SpatialSum& sum, Step step) {
  if (std::optional<Error> error = spatial::rounding_error(sum.drawn().mesh)) {
    if (!step.set.thin.empty()) return *std::move(error);
    Result<SpatialSum::Rounded> merged = sum.rounded();
    if (!merged) return merged.error();
    step.set.set.faces = std::move(merged->mesh.faces);
    step.round(merged->mesh.vertices, std::max(largest_move(step.set), merged->distance));
    return step;
  }
  if (const Result<void> kept = lost_tight(step); !kept) return kept.error();
  step.round(step.set.set.vertices, largest_move(step.set));
  return step;
}

/// The operand of the next step, made of a sum that is not needed any more.
Result<Step> next_operand(Result<SpatialSum> first, BetweenSteps between) {
  if (!first) return first.error();
  const SpatialSum& sum = *first;
  Result<Step> made = vertices_of(sum);
  if (!made) return made;
  Step step = *std::move(made);
  const bool rounds = !step.in_doubles && between == BetweenSteps::rounded;
  spatial::Triangles all = spatial::triangulated(sum);
  if (rounds) all = spatial::split_at_touching_vertices(sum, std::move(all));
  for (const spatial::Triangle& t : all.triangles) step.set.set.faces.push_back({t[0], t[1], t[2]});
  add_tight(sum, step);
  return rounds ? rounded_step(sum, std::move(step)) : step;
}

SolidOpening with(SpatialSum solid, double moved) { return {std::move(solid), moved}; }

/// Operands are meshes or sums.
template <class Operand>
Result<SolidOpening> opening_of(const Operand& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  SpatialOptions inside = options;
  inside.tight = true;  // where b fits without room to move, it covers what no other position does
  inside.trace = false;
  const Result<Step> step = next_operand(erode(a, b, inside), between);
  if (!step) return step.error();
  Result<SpatialSum> sum = step->in_doubles
                               ? spatial::sum_of_operands(spatial::solid_operand(step->set.set, step->set.thin),
                                                          spatial::solid_operand(b.data()), options)
                               : spatial::sum_of_exact_sets(step->set, spatial::exact_set(b.data()), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

template <class Operand>
Result<SolidOpening> closing_of(const Operand& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  if (b.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  SpatialOptions regular = options;
  regular.tight = false;  // the closed sum holds its tight features
  regular.trace = false;
  const Result<Step> step = next_operand(minkowski_sum(a, b, regular), between);
  if (!step) return step.error();
  Result<SpatialSum> sum = step->in_doubles ? spatial::erosion(step->set.set, b.data(), options)
                                            : spatial::erosion(step->set, b.data(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

}  // namespace

Result<SolidOpening> opening(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  return opening_of(a, b, options, between);
}

Result<SolidOpening> opening(const SpatialSum& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  return opening_of(a, b, options, between);
}

Result<SolidOpening> closing(const Mesh& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  if (a.has_thin_parts()) return Error{ErrorCode::unsupported_operand, kThin, {}};
  return closing_of(a, b, options, between);
}

Result<SolidOpening> closing(const SpatialSum& a, const Mesh& b, const SpatialOptions& options, BetweenSteps between) {
  return closing_of(a, b, options, between);
}

}  // namespace dymsum
