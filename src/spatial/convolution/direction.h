// Normals and edges of operands in doubles with a bound, for signs that integers then need not find.
#pragma once

#include <algorithm>
#include <cmath>

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// A vector in doubles: within `error` of the exact one in each component, both scaled so that the largest component is
/// about 1.
struct Direction {
  Vec3 v;
  double error = 0;
};

inline Direction scaled_direction(Vec3 v, double error) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 4 * error)) return {{0, 0, 0}, 4};  // says nothing
  return {(1 / size) * v, error / size + 0x1p-51};
}

inline double direction_norm(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// The direction from one vertex to another, each coordinate of either within `each` of the exact one.
inline Direction edge_direction(Vec3 from, Vec3 to, double each) {
  const Vec3 d = to - from;
  return scaled_direction(d, 2 * each + direction_norm(d) * 0x1p-52);
}

/// The normal of a triangle, likewise.
inline Direction normal_direction(Vec3 a, Vec3 b, Vec3 c, double each) {
  const Vec3 u = b - a, v = c - a;
  const double error =
      direction_norm(u) * direction_norm(v) * 0x1p-50 + 4 * each * (direction_norm(u) + direction_norm(v) + each);
  return scaled_direction(cross(u, v), error);
}

/// The sign of n . d; 0 where doubles leave it open.
inline int filtered_sign(const Direction& n, const Direction& d) {
  const double v = dot(n.v, d.v);
  const double error = 3 * (n.error + d.error + n.error * d.error) + 0x1p-49;
  return v > error ? 1 : v < -error ? -1 : 0;
}

}  // namespace dymsum::spatial
