// Vectors of three exact integers (Int of any widths, or Big): the result types are as wide as the values can be.
#pragma once

#include <array>

#include "exact/int.h"

namespace dymsum::exact {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};
};

template <class A, class B>
auto operator-(const Vector3<A>& a, const Vector3<B>& b) {
  return Vector3<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
auto operator+(const Vector3<A>& a, const Vector3<B>& b) {
  return Vector3<decltype(a.x + b.x)>{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
auto dot(const Vector3<A>& a, const Vector3<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
auto cross(const Vector3<A>& a, const Vector3<B>& b) {
  using R = decltype(a.y * b.z - a.z * b.y);
  return Vector3<R>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Three rows.
template <class T>
using Matrix3 = std::array<Vector3<T>, 3>;

/// m v.
template <class M, class T>
auto apply(const Matrix3<M>& m, const Vector3<T>& v) {
  using R = decltype(dot(m[0], v));
  return Vector3<R>{dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
template <class M>
Matrix3<M> transposed(const Matrix3<M>& m) {
  return {Vector3<M>{m[0].x, m[1].x, m[2].x}, Vector3<M>{m[0].y, m[1].y, m[2].y}, Vector3<M>{m[0].z, m[1].z, m[2].z}};
}

/// The sign of the first component that is not zero; 0 for the zero vector.
template <class T>
int leading_sign(const Vector3<T>& v) {
  if (const int s = sign(v.x)) return s;
  if (const int s = sign(v.y)) return s;
  return sign(v.z);
}

/// The budgets of exact-integer geometry in space, for coordinates |X| <= 2^B: edges, normals of faces, sides of
/// planes.
template <int B>
struct SpatialWidths {
  using Coordinate = Int<B>;
  using Edge = decltype(Coordinate{} - Coordinate{});
  using Normal = decltype(Edge{} * Edge{} - Edge{} * Edge{});
  using Side = decltype(Normal{} * Edge{} + Normal{} * Edge{} + Normal{} * Edge{});
  static_assert(Edge::kBits == B + 1 && Normal::kBits == 2 * B + 3 && Side::kBits == 3 * B + 6);
};
static_assert(sizeof(SpatialWidths<26>::Normal) == 8 && sizeof(SpatialWidths<26>::Side) == 16);
static_assert(sizeof(SpatialWidths<61>::Normal) == 16 && sizeof(SpatialWidths<61>::Side) == 24);

}  // namespace dymsum::exact
