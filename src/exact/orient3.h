// The exact sign of the 3x3 determinant that orients four points of space, for plain doubles of any exponents: a
// floating-point filter with a proved error bound answers almost always; what it leaves open is computed in integers on
// the common grid of the arguments.
#pragma once

#include "dymsum/mesh.h"
#include "exact/int.h"
#include "exact/orient.h"

namespace dymsum::exact {

/// det(u, v, w) of three vectors, generic in the number type. For Int<D> the result is Int<3D + 3>: products of two
/// 2D, their difference 2D + 1, times the third 3D + 1, the sum of three 3D + 3.
template <class Vector>
constexpr auto determinant(const Vector& u, const Vector& v, const Vector& w) {
  const auto x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
  return x * w.x + y * w.y + z * w.z;
}

/// The sign of det(b - a, c - a, d - a): > 0 when d lies on the side of the plane abc from which a, b, c run
/// counter-clockwise, 0 when the four points lie in one plane. Requires finite coordinates. Integers for differences of
/// at most 126 bits, big numbers beyond.
SignAnswer orient3_answer(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

inline int orient3_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return orient3_answer(a, b, c, d).sign;
}
inline int orient3_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d, RungCounts& counts) {
  return counts.add(orient3_answer(a, b, c, d));
}

/// A coordinate axis, and the plane seen from its positive end.
enum class Axis { x, y, z };

/// The point without its coordinate on `axis`; counter-clockwise stays counter-clockwise seen from the axis' positive
/// end.
constexpr Point dropped(const Point3& p, Axis axis) {
  if (axis == Axis::x) return {p.y, p.z};
  if (axis == Axis::y) return {p.z, p.x};
  return {p.x, p.y};
}

/// The sign of the normal's component on `axis`: of (b - a) x (c - a).
inline int normal_sign(const Point3& a, const Point3& b, const Point3& c, Axis axis) {
  return orient_sign(dropped(a, axis), dropped(b, axis), dropped(c, axis));
}

/// a, b, c lie on one line; equal points do.
inline bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  return normal_sign(a, b, c, Axis::z) == 0 && normal_sign(a, b, c, Axis::x) == 0 && normal_sign(a, b, c, Axis::y) == 0;
}

}  // namespace dymsum::exact
