// The edges of a mesh by their sides. Half-edge h is the side of an edge that belongs to one face; it runs from
// origin[h] to origin[next[h]], and the face's half-edges are consecutive, in the order of its vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "exact/orient.h"

namespace dymsum::spatial {

struct HalfEdges {
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<std::uint32_t> face_begin;  ///< per face its first half-edge; one more at the end
  std::vector<std::uint32_t> origin, face, next;
  std::vector<std::uint32_t> twin;  ///< the other side; kNone without exactly one that runs the other way

  std::size_t size() const { return origin.size(); }
  std::uint32_t target(std::uint32_t h) const { return origin[next[h]]; }
  std::uint32_t previous(std::uint32_t h) const {
    return h == face_begin[face[h]] ? face_begin[face[h] + 1] - 1 : h - 1;
  }
};

/// A half-edge with its ends, the smaller one first.
struct EdgeSide {
  std::uint64_t ends = 0;
  std::uint32_t half_edge = 0;
  friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
};

/// All but the twins. Requires faces of at least one vertex. Throws std::length_error from 2^32 - 1 half-edges on.
HalfEdges half_edges_without_twins(const std::vector<Face>& faces);
/// All sides, those of one edge next to each other. O(n log n).
std::vector<EdgeSide> edge_sides(const HalfEdges& edges);
/// Calls f(first, last) for the sides [first, last) of every edge.
template <class F>
void for_each_edge(const std::vector<EdgeSide>& sides, F f) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].ends == sides[first].ends) ++last;
    f(&sides[first], &sides[0] + last);
  }
}
void join_twins(HalfEdges& edges, const std::vector<EdgeSide>& sides);

/// The half-edges of faces, with their twins.
HalfEdges half_edges(const std::vector<Face>& faces);

/// Numbers the sets of faces that are connected by twins, in the order of their first faces.
struct Shells {
  std::vector<std::uint32_t> of_face;
  std::uint32_t count = 0;
};
Shells find_shells(const HalfEdges& edges);

// The plane of a face, exactly, by three of its vertices.

/// Three vertices of a face, not on one line, that run counter-clockwise seen from the face's outside, and an axis on
/// which the face's normal is not zero, with its sign there.
struct FacePlane {
  std::uint32_t a = 0, b = 0, c = 0;
  exact::Axis axis = exact::Axis::z;
  int axis_sign = 0;
};

/// The plane by a strictly convex corner: the lexicographically smallest vertex between its neighbours. Requires a
/// valid face. Exact. O(k).
FacePlane face_plane(const std::vector<Point3>& vertices, const Face& face);

/// The sign of p's height over the face: > 0 outside.
inline int height_sign(const std::vector<Point3>& vertices, const FacePlane& plane, const Point3& p) {
  return exact::orient3_sign(vertices[plane.a], vertices[plane.b], vertices[plane.c], p);
}

/// > 0 when c is to the left of the direction from a to b, seen from the face's outside; all in the face's plane.
inline int turn_sign(const FacePlane& plane, const Point3& a, const Point3& b, const Point3& c) {
  return plane.axis_sign * exact::normal_sign(a, b, c, plane.axis);
}

/// The face in its projection along the plane's axis, counter-clockwise.
Ring projected(const std::vector<Point3>& vertices, const Face& face, const FacePlane& plane);

/// What is wrong with a face by itself, with `vertex` and the position: no_area, not_planar, self_crossing. Requires at
/// least three vertices at different positions. Exact. O(k log k).
std::optional<Error> face_error(const std::vector<Point3>& vertices, const Face& face);

// How the faces of a mesh meet at its edges.

enum class Bend {
  flat,    ///< in one plane, side by side
  convex,  ///< the solid's angle is below 180 degrees
  reflex,  ///< above
  folded   ///< in one plane, on top of each other: an angle of 0 or 360 degrees
};

/// The planes of all faces, by face_plane.
std::vector<FacePlane> face_planes(const MeshData& data);

/// How the two faces at half-edge h meet. Requires valid faces and a twin. Exact. O(k) for k collinear vertices there.
Bend edge_bend(const MeshData& data, const HalfEdges& edges, const std::vector<FacePlane>& planes, std::uint32_t h);

// Edges at which a solid touches itself: more than two faces, in their order around the edge.

/// Two sides of one edge, neighbours around it, that run through it in the same direction or lie on each other: no
/// solid has them.
struct SideClash {
  std::uint32_t half_edge = 0, other = 0;
};

/// Joins the sides of every edge as twins, where more than two meet those with the solid's inside between them.
/// Requires faces that are valid by themselves and as many sides of every edge in one direction as in the other.
/// Returns a clash, if there is one. Exact. O(k log k) for k sides of an edge.
std::optional<SideClash> join_around(HalfEdges& edges, const std::vector<EdgeSide>& sides, const MeshData& data);

/// Membranes: the faces that have to be left out so that those at every edge bound inside and outside by turns, each
/// with the inside on both sides of it. What faces of two sides join is one whole, and left out as such. Empty where
/// there are none, where edges contradict each other, or one has a single face. Requires faces that are valid by
/// themselves. Exact. O(n log n).
std::vector<bool> membranes(const MeshData& data);

/// The half-edges of a valid mesh, all with twins.
HalfEdges half_edges(const MeshData& valid);

}  // namespace dymsum::spatial
