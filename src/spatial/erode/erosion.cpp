#include "spatial/erode/erosion.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/doubles.h"
#include "dymsum/solid_erosion.h"
#include "exact/orient.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/mapped_sum.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/surface_edits.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::spatial {
namespace {

struct Range {
  double low = 0, high = 0;
};

Range range_of(const MeshData& mesh, double Point3::*axis) {
  Range range{mesh.vertices[0].*axis, mesh.vertices[0].*axis};
  for (const Point3& v : mesh.vertices) range = {std::min(range.low, v.*axis), std::max(range.high, v.*axis)};
  return range;
}

/// Ends may be rounded ones, off by an ulp.
bool fits(Range a, Range b) {
  const double ulps = 0x1p-50 * std::max({-a.low, a.high, -b.low, b.high});
  return !(b.high / 2 - b.low / 2 > (a.high / 2 - a.low / 2) * (1 + 0x1p-40) + ulps + 0x1p-1000);
}

constexpr double kLargestFramed = 0x1p1000;

}  // namespace

std::array<double, 2> framed(double low, double high, double length) {
  const double far = std::max({std::abs(low), std::abs(high), 0x1p-1000});
  const double unit = std::ldexp(1.0, std::max(std::ilogb(std::max(length, 0x1p-1000)), std::ilogb(far) - 50));
  return {(std::floor(low / unit) - 3) * unit, (std::ceil(high / unit) + 3) * unit};
}

bool fits_lengthwise(const MeshData& a, const MeshData& b) {
  return fits(range_of(a, &Point3::x), range_of(b, &Point3::x)) &&
         fits(range_of(a, &Point3::y), range_of(b, &Point3::y)) &&
         fits(range_of(a, &Point3::z), range_of(b, &Point3::z));
}

Result<MeshData> framed_complement(const MeshData& a, const MeshData& b) {
  for (std::size_t k = 0; k < a.vertices.size(); ++k) {
    const Point3& v = a.vertices[k];
    if (std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kLargestFramed) continue;
    Error error{ErrorCode::unsupported_operand,
                "a coordinate is larger than 2^1000, too large to look for room inside a solid",
                {}};
    error.evidence.vertex = static_cast<std::int64_t>(k);
    error.evidence.x = v.x, error.evidence.y = v.y, error.evidence.z = v.z;
    return error;
  }
  const auto frame = [&](double Point3::*axis) {
    const Range of_a = range_of(a, axis), of_b = range_of(b, axis);
    // Of no length where b is plane: then any distance does.
    const double length = of_b.high > of_b.low ? of_b.high - of_b.low : of_a.high - of_a.low;
    const auto [low, high] = framed(of_a.low, of_a.high, length);
    return Range{low, high};
  };
  const Range x = frame(&Point3::x), y = frame(&Point3::y), z = frame(&Point3::z);
  MeshData all;
  all.vertices = a.vertices;
  for (const Face& face : a.faces) all.faces.emplace_back(face.rbegin(), face.rend());
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const double at_z : {z.low, z.high})
    for (const auto& [at_x, at_y] :
         {std::pair{x.low, y.low}, std::pair{x.high, y.low}, std::pair{x.high, y.high}, std::pair{x.low, y.high}})
      all.vertices.push_back({at_x, at_y, at_z});
  for (const Face& face :
       {Face{3, 2, 1, 0}, Face{4, 5, 6, 7}, Face{0, 1, 5, 4}, Face{1, 2, 6, 5}, Face{2, 3, 7, 6}, Face{3, 0, 4, 7}}) {
    Face& added = all.faces.emplace_back(face);
    for (std::uint32_t& v : added) v += first;
  }
  return all;
}

// A (-) B is what the sum of the complement of A and -B leaves free. The complement is cut off by a frame so wide that
// positions outside of it form a part of their own, whose surface is all of the frame's features.

namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

MeshData reflected(const MeshData& mesh) {
  MeshData result;
  for (const Point3& v : mesh.vertices) result.vertices.push_back({-v.x, -v.y, -v.z});
  for (const Face& face : mesh.faces) result.faces.emplace_back(face.rbegin(), face.rend());
  return result;
}

/// The sum's free space as a result of its own.
class Inside {
 public:
  Inside(const SpatialSum& sum, const MeshData& a) : sum_(sum), a_(a) {}

  SpatialSum run() {
    drop_frame();
    name_vertices();
    add_faces();
    add_tight();
    result_.at_error = sum_.at_error;
    result_.stats = sum_.stats;
    result_.trace = sum_.trace;
    return std::move(result_);
  }

 private:
  bool of_frame(const SolidFeature& f) const {
    return f.a >= (f.kind == SolidFeature::Kind::face ? a_.faces.size() : a_.vertices.size());
  }
  void drop_frame() {
    outside_.resize(sum_.shells);
    for (const SpatialFace& face : sum_.faces)
      if (of_frame(face.p)) outside_[face.shell] = true;
  }

  void name_vertices() {
    std::vector<bool> used(sum_.vertices.size());
    const auto use = [&](const Loops& loops) {
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop) used[v] = true;
    };
    for (const SpatialFace& face : sum_.faces)
      if (!outside_[face.shell]) use(face.loops);
    for (const Loops& loops : sum_.tight_faces) use(loops);
    for (const auto& [from, to] : sum_.tight_segments) used[from] = used[to] = true;
    for (const std::uint32_t v : sum_.tight_points) used[v] = true;

    const SpatialPositions& old = SpatialSumInternals::positions(sum_);
    auto positions = std::make_shared<SpatialPositions>();
    positions->space = old.space;
    positions->scale = old.scale, positions->shift = old.shift;
    name_.resize(used.size());
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      name_[v] = static_cast<std::uint32_t>(result_.vertices.size());
      result_.vertices.push_back(sum_.vertices[v]);
      result_.vertex_contacts.push_back(sum_.vertex_contacts[v]);
      positions->vertices.push_back(old.vertices[v]);
    }
    SpatialSumInternals::set_positions(result_, std::move(positions));
  }

  std::vector<std::uint32_t> named(const std::vector<std::uint32_t>& loop) const {
    std::vector<std::uint32_t> names;
    for (const std::uint32_t v : loop) names.push_back(name_[v]);
    return names;
  }

  /// Seen from the other side.
  void add_faces() {
    for (const SpatialFace& face : sum_.faces) {
      if (outside_[face.shell]) continue;
      SpatialFace turned = face;
      for (auto& loop : turned.loops) {
        loop = named(loop);
        std::reverse(loop.begin(), loop.end());
        start_at_smallest(loop);
      }
      std::sort(turned.loops.begin() + 1, turned.loops.end());
      result_.faces.push_back(std::move(turned));
    }
    std::sort(result_.faces.begin(), result_.faces.end(),
              [](const SpatialFace& x, const SpatialFace& y) { return x.loops < y.loops; });
    std::vector<std::uint32_t> shell(sum_.shells, 0xffffffff);
    for (SpatialFace& face : result_.faces) {
      std::uint32_t& s = shell[face.shell];
      if (s == 0xffffffff) s = static_cast<std::uint32_t>(result_.shells++);
      face.shell = s;
    }
    std::vector<std::optional<SolidContact>> contacts;  // in the order of edges: names keep that of vertices
    for (const SpatialEdge& edge : sum_.edges())
      if (!outside_[sum_.faces[edge.faces[0]].shell]) contacts.push_back(edge.contact);
    SpatialSumInternals::set_edge_contacts(result_, std::move(contacts));
  }

  void add_tight() {
    for (const Loops& loops : sum_.tight_faces) {
      Loops& to = result_.tight_faces.emplace_back();
      for (const auto& loop : loops) to.push_back(named(loop));
    }
    for (const auto& [from, to] : sum_.tight_segments) result_.tight_segments.push_back({name_[from], name_[to]});
    result_.tight_points = named(sum_.tight_points);
    result_.tight_face_contacts = sum_.tight_face_contacts;
    result_.tight_segment_contacts = sum_.tight_segment_contacts;
    result_.tight_point_contacts = sum_.tight_point_contacts;
  }

  const SpatialSum& sum_;
  const MeshData& a_;
  std::vector<bool> outside_;        // shells of the frame
  std::vector<std::uint32_t> name_;  // per vertex
  SpatialSum result_;
};

/// A vertex of -B that an error tells is one of B.
Error of_operands(Error error, const MeshData& b) {
  Evidence& e = error.evidence;
  if (!e.vertex || !e.x || static_cast<std::size_t>(*e.vertex) >= b.vertices.size()) return error;
  const Point3& v = b.vertices[static_cast<std::size_t>(*e.vertex)];
  if (Point3{-*e.x, -*e.y, -*e.z} == v) e.x = v.x, e.y = v.y, e.z = v.z;
  return error;
}

/// `sum_with` adds the reflected b to the complement of a.
template <class F>
Result<SpatialSum> inside_of(const MeshData& a, const MeshData& b, F sum_with) {
  if (b.faces.empty()) return Error{ErrorCode::unsupported_operand, "every position holds the empty solid", {}};
  if (a.faces.empty() || !fits_lengthwise(a, b)) return SpatialSum();
  Result<MeshData> complement = framed_complement(a, b);
  if (!complement) return complement.error();
  const Result<SpatialSum> sum = sum_with(*std::move(complement), reflected(b));
  if (!sum) return of_operands(sum.error(), b);
  return Inside(*sum, a).run();
}

/// Of a set without thin parts.
Result<SpatialSum> erosion_of_regular(const ExactSet& a, const ExactSet& b, const SpatialOptions& options) {
  return inside_of(a.set, b.set, [&](MeshData complement, MeshData reflection) {
    ExactSet outside = exact_set(std::move(complement));  // of which the frame comes after a
    std::copy(a.at.begin(), a.at.end(), outside.at.begin());
    ExactSet inverse = exact_set(std::move(reflection), b.thin);
    for (std::size_t v = 0; v < b.at.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) inverse.at[v][axis] = -b.at[v][axis];
    return sum_of_exact_sets(outside, inverse, options);
  });
}

}  // namespace

Result<SpatialSum> erosion(const MeshData& a, const MeshData& b, const SpatialOptions& options) {
  return inside_of(a, b, [&](const MeshData& complement, const MeshData& reflection) {
    return sum_of_solids(complement, reflection, options);
  });
}

Result<SpatialSum> erosion(const ExactSet& a, const ExactSet& b, const SpatialOptions& options) {
  if (a.thin.empty()) return erosion_of_regular(a, b, options);
  if (b.thin.empty()) return erosion_of_regular(regular_part(a), b, options);
  return Error{ErrorCode::unsupported_operand,
               "both operands have parts without volume, or are tight in parts: which of these fit into each other is "
               "not determined; with regular semantics those of results do not count",
               {}};
}

}  // namespace dymsum::spatial

namespace dymsum {

// Erosion and sum one after the other.

Result<SpatialSum> erode(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  if (a.has_thin_parts() || b.has_thin_parts())
    return spatial::erosion(spatial::exact_set(a.data(), a.thin_faces()), spatial::exact_set(b.data(), b.thin_faces()),
                            options);
  return spatial::erosion(a.data(), b.data(), options);
}

Result<SpatialSum> erode(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
  const spatial::OperandSet part(b, options.semantics);
  // What is tight in A holds nothing of a solid.
  const spatial::OperandSet around(a, part.has_thin() ? options.semantics : Semantics::regular);
  const SpatialSum *outer = spatial::result_of(a), *inner = spatial::result_of(b);
  const auto of_meshes = [&](const Mesh& x, const Mesh& y) { return erode(x, y, options); };
  if (outer != nullptr && inner != nullptr && !part.has_thin())
    if (auto fit = spatial::before_mapping(*outer, *inner, -1, of_meshes)) return *std::move(fit);
  if (around.mesh() && part.mesh()) return erode(*around.mesh(), *part.mesh(), options);
  return spatial::erosion(around.set(), part.set(), options);
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

}  // namespace

Result<SolidOpening> opening(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options,
                             BetweenSteps between) {
  SpatialOptions inside = options;
  inside.tight = true;  // where b fits without room to move, it covers what no other position does
  inside.trace = false;
  const Result<Step> step = next_operand(erode(a, b, inside), between);
  if (!step) return step.error();
  const spatial::OperandSet part(b, options.semantics);
  Result<SpatialSum> sum = spatial::sum_of_exact_sets(step->set, part.set(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

Result<SolidOpening> closing(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options,
                             BetweenSteps between) {
  const spatial::OperandSet part(b, options.semantics);
  SpatialOptions first = options;
  if (first.semantics == Semantics::open) first.semantics = Semantics::closed;
  first.tight = part.has_thin();  // of others the regular part of the sum holds what is tight
  first.trace = false;
  Result<SpatialSum> grown = minkowski_sum(a, b, first);
  if (!grown) return grown.error();
  const Result<Step> step = next_operand(std::move(grown), between);
  if (!step) return step.error();
  Result<SpatialSum> sum = spatial::erosion(step->set, part.set(), options);
  if (!sum) return sum.error();
  return with(*std::move(sum), step->moved);
}

}  // namespace dymsum
