#include "io/mesh/solid_sum_fault.h"

#include <algorithm>
#include <string>
#include <utility>

#include "spatial/boolean/solid_inside.h"
#include "spatial/sum/face_triangles.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::io {

namespace {

using exact::BigInteger;
using spatial::SpatialSumInternals;
using Loops = std::vector<std::vector<std::uint32_t>>;

Error fault(std::string message) { return {ErrorCode::malformed, std::move(message), {}}; }
Error fault_of_face(std::size_t face, const std::string& message) {
  Error error = fault(message);
  error.evidence.face = static_cast<std::int64_t>(face);
  return error;
}

class FaultSearch {
 public:
  explicit FaultSearch(const SpatialSum& sum) : sum_(sum), signs_(sum) {}

  std::optional<Error> run() {
    if (auto error = fault_of_vertices()) return error;
    if (auto error = fault_of_shells()) return error;
    if (auto error = fault_of_planes()) return error;
    if (auto error = fault_of_tight()) return error;
    if (sum_.vertices.empty()) return std::nullopt;
    if (const auto face = spatial::first_without_triangles(sum_)) return named(*face, "has loops that cross");
    return fault_of_solid();
  }

 private:
  Error fault_of_vertex(std::size_t v, const std::string& message) const {
    Error error = fault(message);
    const Point3& at = sum_.vertices[v];
    error.evidence.vertex = static_cast<std::int64_t>(v);
    error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
    return error;
  }
  /// Of a face, or a tight one, which are counted after the others.
  Error named(std::size_t face, const std::string& message) const {
    if (face < sum_.faces.size()) return fault_of_face(face, "the face " + message);
    return fault("tight face " + std::to_string(face - sum_.faces.size()) + " " + message);
  }

  std::optional<Error> fault_of_vertices() const {
    std::vector<bool> used(sum_.vertices.size());
    const auto use = [&](const Loops& loops) {
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop) used[v] = true;
    };
    for (const SpatialFace& face : sum_.faces) use(face.loops);
    for (const Loops& loops : sum_.tight_faces) use(loops);
    for (const auto& [from, to] : sum_.tight_segments) used[from] = used[to] = true;
    for (const std::uint32_t v : sum_.tight_points) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) return fault_of_vertex(v, "no face and no tight feature has this vertex");
      if (v > 0 && !before(v - 1, v)) return fault_of_vertex(v, "the vertices are not in the order of x, y, z");
    }
    return std::nullopt;
  }
  bool before(std::size_t a, std::size_t b) const {
    const spatial::SpatialPositions& positions = SpatialSumInternals::positions(sum_);
    const auto p = positions.homogeneous(a), q = positions.homogeneous(b);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const int order = BigInteger(p[axis] * q[3]).compare(BigInteger(q[axis] * p[3]))) return order < 0;
    return false;
  }

  std::optional<Error> fault_of_shells() const {
    std::size_t named = 0;
    for (std::size_t f = 0; f < sum_.faces.size(); ++f) {
      if (sum_.faces[f].shell > named) return fault_of_face(f, "shells are not named in the order of their faces");
      if (sum_.faces[f].shell == named) ++named;
    }
    if (named == sum_.shells) return std::nullopt;
    return fault("the faces have " + std::to_string(named) + " shells, not " + std::to_string(sum_.shells));
  }

  std::optional<Error> fault_of_planes() {
    for (std::size_t f = 0; f < sum_.faces.size() + sum_.tight_faces.size(); ++f) {
      const Loops& loops = f < sum_.faces.size() ? sum_.faces[f].loops : sum_.tight_faces[f - sum_.faces.size()];
      const std::array<std::uint32_t, 3> corner{loops[0].back(), loops[0][0], loops[0][1]};
      if (is_straight(corner)) return named(f, "has no corner at its first vertex");
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop)
          if (signs_.side(corner[0], corner[1], corner[2], v) != 0) return named(f, "is not plane");
    }
    return std::nullopt;
  }
  bool is_straight(const std::array<std::uint32_t, 3>& corner) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (signs_.turn(corner[0], corner[1], corner[2], axis) != 0) return false;
    return true;
  }

  std::optional<Error> fault_of_tight() const {
    const auto ascending = [](const auto& list) {
      return std::adjacent_find(list.begin(), list.end(), [](const auto& a, const auto& b) { return !(a < b); }) ==
             list.end();
    };
    for (const auto& [from, to] : sum_.tight_segments)
      if (from >= to) return fault("a tight segment does not run from its smaller end to the larger one");
    if (!ascending(sum_.tight_faces)) return fault("the tight faces are not in their order");
    if (!ascending(sum_.tight_segments)) return fault("the tight segments are not in their order");
    if (!ascending(sum_.tight_points)) return fault("the tight points are not in their order");
    return std::nullopt;
  }

  /// Compares the boundary with that of the solid that it bounds.
  std::optional<Error> fault_of_solid() const {
    const Result<SpatialSum> solid = spatial::solid_inside(spatial::exact_set(sum_), {}, {});
    if (!solid) {
      Error error = solid.error();
      if (error.code == ErrorCode::not_closed) error.code = ErrorCode::malformed;
      return error;
    }
    std::vector<std::uint32_t> name(sum_.vertices.size());
    if (std::optional<Error> error = name_vertices(*solid, name)) return error;
    for (std::size_t f = 0; f < std::max(sum_.faces.size(), solid->faces.size()); ++f) {
      if (f >= sum_.faces.size()) return fault("the solid that the faces bound has more of them");
      if (f < solid->faces.size() && solid->faces[f].shell == sum_.faces[f].shell &&
          solid->faces[f].loops == renamed(sum_.faces[f].loops, name))
        continue;
      return fault_of_face(f,
                           "the faces are none of a result: this one is not what bounds the solid of all of them, or "
                           "not in its order");
    }
    return std::nullopt;
  }
  /// Of every vertex of a face: which one of the solid it is.
  std::optional<Error> name_vertices(const SpatialSum& solid, std::vector<std::uint32_t>& name) const {
    std::vector<bool> of_face(sum_.vertices.size());
    for (const SpatialFace& face : sum_.faces)
      for (const auto& loop : face.loops)
        for (const std::uint32_t v : loop) of_face[v] = true;
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < of_face.size(); ++v) {
      if (!of_face[v]) continue;
      if (next >= solid.vertices.size() ||
          SpatialSumInternals::positions(solid).at(next) != SpatialSumInternals::positions(sum_).at(v))
        return fault_of_vertex(v,
                               "the faces are none of a result: the solid that they bound has other vertices than this "
                               "one");
      name[v] = next++;
    }
    if (next == solid.vertices.size()) return std::nullopt;
    return fault("the faces are none of a result: the solid that they bound has more vertices");
  }
  static Loops renamed(Loops loops, const std::vector<std::uint32_t>& name) {
    for (auto& loop : loops)
      for (std::uint32_t& v : loop) v = name[v];
    return loops;
  }

  const SpatialSum& sum_;
  spatial::VertexSigns signs_;
};

}  // namespace

std::optional<Error> solid_sum_fault(const SpatialSum& sum) { return FaultSearch(sum).run(); }

}  // namespace dymsum::io
