// The plane of a face, exactly, by three of its vertices.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "exact/orient.h"

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
