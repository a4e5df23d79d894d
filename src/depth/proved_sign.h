// Signs of volumes that doubles prove.
#pragma once

#include <algorithm>
#include <cmath>

#include "spatial/mesh/vec3.h"

namespace dymsum::depth {

inline double largest(spatial::Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The sign of six volumes of a tetrahedron with these edges, whose components are off by `off` at most, where it is
/// proved, else 0: products of three are off by 6 (A B + B C + C A) off, their sum in doubles by less than 2^-48 A B C,
/// A, B and C being the largest components. Requires edges of about 1 or less, so that nothing overflows.
inline int proved_sign(spatial::Vec3 a, spatial::Vec3 b, spatial::Vec3 c, double off) {
  const double A = largest(a) + off, B = largest(b) + off, C = largest(c) + off;
  const double v = spatial::dot(spatial::cross(a, b), c);
  const double error = 6 * off * (A * B + B * C + C * A) + 0x1p-48 * A * B * C;
  return v > error ? 1 : v < -error ? -1 : 0;
}

}  // namespace dymsum::depth
