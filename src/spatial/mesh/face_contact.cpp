#include "spatial/mesh/face_contact.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "exact/orient.h"

namespace dymsum::spatial {

namespace {

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
