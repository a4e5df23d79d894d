// Vectors of doubles for filters, pictures and reports; no decision rests on them alone.
#pragma once

#include <array>
#include <cmath>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Three rows.
using Mat3 = std::array<Vec3, 3>;
inline Vec3 operator*(const Mat3& m, Vec3 v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
/// The row vector v m.
inline Vec3 row_times(Vec3 v, const Mat3& m) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }
inline Mat3 transposed(const Mat3& m) {
  return {Vec3{m[0].x, m[1].x, m[2].x}, Vec3{m[0].y, m[1].y, m[2].y}, Vec3{m[0].z, m[1].z, m[2].z}};
}
inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  return {row_times(a[0], b), row_times(a[1], b), row_times(a[2], b)};
}

}  // namespace dymsum::spatial
