#include "spatial/mesh/mesh_validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

// What two faces have in common that they may not, distinguished: the error of a surface that meets itself.

using exact::orient3_sign;

using exact::orient_sign;

/// A face and its triangles, of which a side is an edge of the face or runs through its inside.
struct SplitFace {
  std::uint32_t index;
  const Face& corners;
  std::span<const Triangle> triangles;

  bool has(std::uint32_t v) const { return std::find(corners.begin(), corners.end(), v) != corners.end(); }
  bool has_edge(std::uint32_t from, std::uint32_t to) const {
    const auto at = std::find(corners.begin(), corners.end(), from);
    return (at + 1 == corners.end() ? corners.front() : at[1]) == to;
  }
};

/// The part of a triangle in which a point of a face's plane lies, or the crossing of a line with it.
enum class Position { outside, corner, edge, inside };

struct EdgePosition {
  Position position = Position::outside;
  std::uint32_t from = 0;  ///< the first vertex of the edge
};

/// The position that the signs of turns around a triangle's edges determine.
EdgePosition position_of(const SplitFace& face, const Triangle& t, const std::array<int, 3>& signs) {
  const auto [least, most] = std::minmax_element(signs.begin(), signs.end());
  if (*least * *most < 0) return {};
  const auto zeros = std::count(signs.begin(), signs.end(), 0);
  if (zeros > 1) return {Position::corner, 0};
  for (std::size_t k = 0; k < 3 && zeros == 1; ++k)
    if (signs[k] == 0 && face.has_edge(t[k], t[(k + 1) % 3])) return {Position::edge, t[k]};
  return {Position::inside, 0};
}

class ContactSearch {
 public:
  ContactSearch(const MeshData& data, const Triangles& triangles, const FaceMeeting& meeting)
      : data_(data), meeting_(meeting), f_(split(triangles, meeting.face)), g_(split(triangles, meeting.other_face)) {}

  Error run() const {
    const auto between_faces = [&](const char* message) {
      return made(message, meeting_.face, meeting_.other_face, std::nullopt, std::nullopt, meeting_.at);
    };
    if (pierced(f_, g_) || pierced(g_, f_)) return between_faces("two faces cross");
    if (lie_on_each_other()) return between_faces("two faces lie on each other");
    for (const Position where : {Position::inside, Position::edge})
      for (const auto& [from, to] : {std::pair{&f_, &g_}, std::pair{&g_, &f_}})
        if (const std::optional<Error> error = vertex_contact(*from, *to, where)) return *error;
    if (const std::optional<Error> error = edge_contact()) return *error;
    return between_faces("two faces cross or touch where they share no vertex and no edge");
  }

 private:
  SplitFace split(const Triangles& all, std::uint32_t face) const {
    const auto [first, last] = std::equal_range(all.face.begin(), all.face.end(), face);
    return {face,
            data_.faces[face],
            {all.triangles.data() + (first - all.face.begin()), static_cast<std::size_t>(last - first)}};
  }
  const Point3& at(std::uint32_t v) const { return data_.vertices[v]; }

  static Error made(const char* message, std::uint32_t face, std::uint32_t other_face,
                    std::optional<std::uint32_t> vertex, std::optional<std::uint32_t> other_vertex, const Point3& at) {
    Error error{ErrorCode::faces_cross, message, {}};
    error.evidence.face = face, error.evidence.other_face = other_face;
    if (vertex) error.evidence.vertex = *vertex;
    if (other_vertex) error.evidence.other_vertex = *other_vertex;
    error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
    return error;
  }

  int side(const Triangle& plane, std::uint32_t v) const {
    return orient3_sign(at(plane[0]), at(plane[1]), at(plane[2]), at(v));
  }

  /// The position at which an edge whose ends lie on both sides of a triangle's plane runs through it.
  EdgePosition crossing(const SplitFace& face, const Triangle& t, std::uint32_t u, std::uint32_t v) const {
    std::array<int, 3> signs{};
    for (std::size_t k = 0; k < 3; ++k) signs[k] = orient3_sign(at(u), at(v), at(t[k]), at(t[(k + 1) % 3]));
    return position_of(face, t, signs);
  }
  /// f(u, v, t) for the edges of one face and the triangles of the other whose planes they cross.
  template <class F>
  bool any_crossing(const SplitFace& edges, const SplitFace& face, F f) const {
    for (std::size_t k = 0; k < edges.corners.size(); ++k) {
      const std::uint32_t u = edges.corners[k], v = edges.corners[(k + 1) % edges.corners.size()];
      for (const Triangle& t : face.triangles)
        if (side(t, u) * side(t, v) < 0 && f(u, v, t)) return true;
    }
    return false;
  }
  bool pierced(const SplitFace& edges, const SplitFace& face) const {
    return any_crossing(edges, face, [&](std::uint32_t u, std::uint32_t v, const Triangle& t) {
      return crossing(face, t, u, v).position == Position::inside;
    });
  }

  exact::Axis axis_across(const Triangle& t) const {
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x})
      if (exact::normal_sign(at(t[0]), at(t[1]), at(t[2]), axis) != 0) return axis;
    return exact::Axis::y;
  }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const {
    return exact::normal_sign(at(a), at(b), at(c), axis);
  }

  /// Two triangles of one plane have common inner points unless a facet edge of one has the other one beyond it.
  bool overlap(const Triangle& s, const Triangle& t) const {
    for (const std::uint32_t v : t)
      if (side(s, v) != 0) return false;
    const exact::Axis axis = axis_across(s);
    const auto separates = [&](const Triangle& a, const Triangle& b) {
      const int facing = turn(a[0], a[1], a[2], axis);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto beyond = [&](std::uint32_t v) { return facing * turn(a[k], a[(k + 1) % 3], v, axis) <= 0; };
        if (std::all_of(b.begin(), b.end(), beyond)) return true;
      }
      return false;
    };
    return !separates(s, t) && !separates(t, s);
  }
  bool lie_on_each_other() const {
    for (const Triangle& s : f_.triangles)
      for (const Triangle& t : g_.triangles)
        if (overlap(s, t)) return true;
    return false;
  }

  /// A vertex of one face inside the other one, or inside an edge of it.
  std::optional<Error> vertex_contact(const SplitFace& from, const SplitFace& to, Position where) const {
    for (const std::uint32_t v : from.corners) {
      if (to.has(v)) continue;
      for (const Triangle& t : to.triangles) {
        if (side(t, v) != 0) continue;
        const exact::Axis axis = axis_across(t);
        std::array<int, 3> signs{};
        for (std::size_t k = 0; k < 3; ++k) signs[k] = turn(t[k], t[(k + 1) % 3], v, axis);
        const EdgePosition position = position_of(to, t, signs);
        if (position.position != where) continue;
        if (where == Position::inside)
          return made("a vertex touches this face inside", to.index, from.index, v, std::nullopt, at(v));
        return made("a vertex touches an edge of this face between its ends", to.index, from.index, v, position.from,
                    at(v));
      }
    }
    return std::nullopt;
  }

  std::optional<Error> edge_contact() const {
    std::optional<Error> error;
    any_crossing(f_, g_, [&](std::uint32_t u, std::uint32_t v, const Triangle& t) {
      if (crossing(g_, t, u, v).position != Position::edge) return false;
      error =
          made("an edge touches one of another face between the ends of both", f_.index, g_.index, u, v, meeting_.at);
      return true;
    });
    return error;
  }

  const MeshData& data_;
  const FaceMeeting& meeting_;
  SplitFace f_, g_;
};

}  // namespace

Error contact_error(const MeshData& data, const Triangles& triangles, const FaceMeeting& meeting) {
  return ContactSearch(data, triangles, meeting).run();
}

}  // namespace dymsum::spatial

namespace dymsum {

Result<Mesh> Mesh::create(MeshData data) {
  spatial::MeshValidation checked = spatial::validate(data);
  if (checked.error) return *std::move(checked.error);
  return spatial::trusted_mesh(std::move(data), checked.shells);
}

Result<Mesh> Mesh::with_thin_parts(MeshData data) {
  std::vector<bool> thin;
  spatial::MeshValidation checked = spatial::validate_with_thin_parts(data, thin);
  if (checked.error) return *std::move(checked.error);
  return spatial::trusted_mesh(std::move(data), checked.shells, std::move(thin));
}

namespace spatial {

struct MeshInternals {
  static Mesh make(MeshData data, std::size_t shells, std::vector<bool> thin) {
    Mesh mesh;
    mesh.data_ = std::move(data);
    mesh.shells_ = shells;
    mesh.thin_ = std::move(thin);
    return mesh;
  }
};

Mesh trusted_mesh(MeshData data, std::size_t shells, std::vector<bool> thin) {
  return MeshInternals::make(std::move(data), shells, std::move(thin));
}

std::optional<Error> check_finite(const std::vector<Point3>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point3& p = vertices[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    Error error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
    error.evidence.vertex = static_cast<std::int64_t>(i);
    return error;
  }
  return std::nullopt;
}

std::optional<Error> check_indices(const MeshData& data) {
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    for (const std::uint32_t v : data.faces[f]) {
      if (v < data.vertices.size()) continue;
      Error error{ErrorCode::bad_index, "a face names a vertex that does not exist", {}};
      error.evidence.face = static_cast<std::int64_t>(f);
      error.evidence.vertex = v;
      return error;
    }
  }
  return std::nullopt;
}

namespace {

class MeshCheck {
 public:
  /// `least` vertices a face.
  MeshCheck(const MeshData& data, std::size_t least) : data_(data), least_(least) {}

  /// Vertices, and faces by themselves.
  std::optional<Error> check_lists() const {
    if (auto error = check_finite(data_.vertices)) return error;
    if (auto error = check_indices(data_)) return error;
    if (auto error = check_corners()) return error;
    if (auto error = check_positions()) return error;
    if (auto error = check_use()) return error;
    return check_faces();
  }
  /// How faces meet.
  std::optional<Error> check_surface() {
    edges_ = half_edges_without_twins(data_.faces);
    if (auto error = check_edges()) return error;
    if (auto error = check_volumes()) return error;
    triangles_ = triangulated(data_);
    boxes_ = boxes_of(data_.vertices, triangles_.triangles);
    if (auto error = check_meetings()) return error;
    return check_orientations();
  }
  std::size_t shell_count() const { return shells_.count; }

 private:
  Error error_at(ErrorCode code, std::string message, std::uint32_t vertex) const {
    Error error{code, std::move(message), {}};
    const Point3& p = data_.vertices[vertex];
    error.evidence.vertex = vertex;
    error.evidence.x = p.x;
    error.evidence.y = p.y;
    error.evidence.z = p.z;
    return error;
  }
  Error edge_error(ErrorCode code, std::string message, std::uint32_t h) const {
    Error error = error_at(code, std::move(message), edges_.origin[h]);
    error.evidence.other_vertex = edges_.target(h);
    error.evidence.face = edges_.face[h];
    return error;
  }

  std::optional<Error> check_corners() const {
    std::vector<std::size_t> last_face(data_.vertices.size(), data_.faces.size());
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const Face& face = data_.faces[f];
      if (face.size() < least_) {
        Error error{ErrorCode::too_few_vertices,
                    least_ == 1 ? "a face without vertices" : "a face needs at least three vertices",
                    {}};
        if (!face.empty()) error = error_at(error.code, std::move(error.message), face[0]);
        error.evidence.face = static_cast<std::int64_t>(f);
        return error;
      }
      for (const std::uint32_t v : face) {
        if (std::exchange(last_face[v], f) != f) continue;
        Error error = error_at(ErrorCode::repeated_vertex, "a face has a vertex twice", v);
        error.evidence.face = static_cast<std::int64_t>(f);
        return error;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> check_positions() const {
    const std::vector<std::uint32_t> order = order_by_position(data_.vertices);
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (data_.vertices[order[i - 1]] != data_.vertices[order[i]]) continue;
      Error error = error_at(ErrorCode::repeated_vertex, "two vertices are at the same place", order[i - 1]);
      error.evidence.other_vertex = order[i];
      return error;
    }
    return std::nullopt;
  }

  std::optional<Error> check_use() const {
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces) {
      for (const std::uint32_t v : face) used[v] = true;
    }
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused == used.end()) return std::nullopt;
    return error_at(ErrorCode::bad_index, "no face uses this vertex",
                    static_cast<std::uint32_t>(unused - used.begin()));
  }

  std::optional<Error> check_faces() const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (data_.faces[f].size() < 3) continue;
      std::optional<Error> error = face_error(data_.vertices, data_.faces[f]);
      if (!error) continue;
      error->evidence.face = static_cast<std::int64_t>(f);
      return error;
    }
    return std::nullopt;
  }

  std::optional<Error> check_edges() {
    const std::vector<EdgeSide> sides = edge_sides(edges_);
    std::optional<Error> found;
    for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
      if (!found) found = edge_error_of(first, last);
    });
    if (found) return found;
    const std::optional<SideClash> clash = join_around(edges_, sides, data_);
    if (!clash) return std::nullopt;
    Error error = edge_error(ErrorCode::not_manifold,
                             "the faces around an edge do not bound inside and outside by turns", clash->half_edge);
    error.evidence.other_face = edges_.face[clash->other];
    return error;
  }

  std::optional<Error> edge_error_of(const EdgeSide* first, const EdgeSide* last) const {
    const std::uint32_t h = first->half_edge;
    const auto count = last - first;
    if (count == 1) return edge_error(ErrorCode::not_closed, "an edge has a face on one side only", h);
    const auto along =
        std::count_if(first, last, [&](const EdgeSide& s) { return edges_.origin[s.half_edge] == edges_.origin[h]; });
    if (2 * along == count) return std::nullopt;
    Error error = count % 2 == 1
                      ? edge_error(ErrorCode::not_manifold, "an edge has an odd number of faces", h)
                      : edge_error(ErrorCode::wrong_orientation, "two faces run through an edge in one direction", h);
    error.evidence.other_face = edges_.face[first[1].half_edge];
    return error;
  }

  std::optional<Error> check_meetings() const {
    const std::optional<FaceMeeting> meeting = find_meeting(data_, triangles_, boxes_);
    if (!meeting) return std::nullopt;
    return contact_error(data_, triangles_, *meeting);
  }

  std::optional<Error> check_volumes() {
    shells_ = find_shells(edges_);
    signs_ = shell_signs(data_, shells_);
    return first_face([&](std::uint32_t shell) { return signs_[shell] == 0; }, ErrorCode::no_area,
                      "a shell encloses no volume");
  }

  std::optional<Error> check_orientations() const {
    const std::vector<std::uint32_t> depths = shell_depths(data_, shells_, triangles_, boxes_);
    if (auto error = first_face([&](std::uint32_t shell) { return depths[shell] % 2 == 0 && signs_[shell] < 0; },
                                ErrorCode::wrong_orientation, "a shell is inside out")) {
      return error;
    }
    return first_face([&](std::uint32_t shell) { return depths[shell] % 2 == 1 && signs_[shell] > 0; },
                      ErrorCode::wrong_orientation, "a shell inside another one does not run inward, around a cavity");
  }

  /// The error at the first face of a shell that is wrong.
  template <class Wrong>
  std::optional<Error> first_face(Wrong wrong, ErrorCode code, const char* message) const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (!wrong(shells_.of_face[f])) continue;
      Error error = error_at(code, message, data_.faces[f][0]);
      error.evidence.face = static_cast<std::int64_t>(f);
      return error;
    }
    return std::nullopt;
  }

  const MeshData& data_;
  std::size_t least_;
  HalfEdges edges_;
  Triangles triangles_;
  BoxTree boxes_;
  Shells shells_;
  std::vector<int> signs_;  // of the shells' volumes
};

/// The faces that are not thin.
struct SolidFaces {
  SolidFaces(const MeshData& all, const std::vector<bool>& thin) : data{all.vertices, {}} {
    for (std::size_t f = 0; f < all.faces.size(); ++f) {
      if (!thin.empty() && thin[f]) continue;
      data.faces.push_back(all.faces[f]);
      origin.push_back(static_cast<std::int64_t>(f));
    }
  }
  MeshData data;
  std::vector<std::int64_t> origin;
};

}  // namespace

MeshValidation validate(const MeshData& data) {
  MeshCheck check(data, 3);
  if (auto error = check.check_lists()) return {std::move(error), 0};
  if (auto error = check.check_surface()) return {std::move(error), 0};
  return {std::nullopt, check.shell_count()};
}

MeshValidation validate_with_thin_parts(const MeshData& data, std::vector<bool>& thin) {
  if (auto error = MeshCheck(data, 1).check_lists()) return {std::move(error), 0};
  thin = thin_faces(data.faces);
  SolidFaces solid(data, thin);
  if (const std::vector<bool> inner = membranes(solid.data); !inner.empty()) {
    thin.resize(data.faces.size());
    for (std::size_t f = 0; f < inner.size(); ++f)
      if (inner[f]) thin[static_cast<std::size_t>(solid.origin[f])] = true;
    solid = SolidFaces(data, thin);
  }
  MeshCheck check(solid.data, 3);
  std::optional<Error> error = check.check_surface();
  if (!error) return {std::nullopt, check.shell_count()};
  for (auto* face : {&error->evidence.face, &error->evidence.other_face})
    if (*face) *face = solid.origin[static_cast<std::size_t>(**face)];
  return {std::move(error), 0};
}

}  // namespace spatial

}  // namespace dymsum
