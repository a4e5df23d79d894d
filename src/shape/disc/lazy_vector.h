// Vectors in intervals, and exactly when these do not decide.
#pragma once

#include <functional>

#include "shape/disc/disc_formulas.h"

namespace dymsum::shape {

template <class T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
Vector<T> plus(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y};
}

/// The position at which a circle of radius r is crossed by that about `d`, clockwise of d or counter-clockwise; where
/// they touch, in case |d| = 2 r. Requires |d| <= 2 r.
template <class T>
Vector<T> crossing(const Vector<T>& d, const T& r, bool clockwise) {
  const T half = T(0.5);
  const T w = sqrt(r * r / dot(d, d) - half * half);
  const T v = clockwise ? -w : w;
  return {half * d.x - d.y * v, half * d.y + d.x * v};
}

struct LazyVector {
  Vector<exact::Interval> near;
  std::function<Vector<exact::RootExpression>()> exact;
};

inline int sign_of_cross(const LazyVector& a, const LazyVector& b) {
  if (const auto sign = sign_of(cross(a.near, b.near))) return *sign;
  return exact::sign_of(cross(a.exact(), b.exact()));
}
inline int sign_of_y(const LazyVector& a) {
  if (const auto sign = sign_of(a.near.y)) return *sign;
  return exact::sign_of(a.exact().y);
}

}  // namespace dymsum::shape
