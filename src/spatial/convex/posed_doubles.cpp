#include "spatial/convex/posed_doubles.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {
namespace {

Mat3 columns_scaled(const Mat3& m, const std::array<double, 3>& s) {
  Mat3 scaled;
  for (std::size_t r = 0; r < 3; ++r) scaled[r] = {m[r].x * s[0], m[r].y * s[1], m[r].z * s[2]};
  return scaled;
}

Mat3 rotation_in_doubles(const Rotation& rotation) {
  const std::array<std::int64_t, 9> n = rotation.matrix();
  const auto norm = static_cast<double>(rotation.norm());
  const auto at = [&](std::size_t k) { return static_cast<double>(n[k]) / norm; };
  return {Vec3{at(0), at(1), at(2)}, Vec3{at(3), at(4), at(5)}, Vec3{at(6), at(7), at(8)}};
}

}  // namespace

int exponent_of(const Mat3& m) {
  double most = 0;
  for (const Vec3& row : m) most = std::max({most, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
  return std::ilogb(most);
}

Mat3 scaled_by_power(const Mat3& m, int exponent) {
  Mat3 scaled;
  for (std::size_t r = 0; r < 3; ++r)
    scaled[r] = {std::ldexp(m[r].x, exponent), std::ldexp(m[r].y, exponent), std::ldexp(m[r].z, exponent)};
  return scaled;
}

// Roundings of an entry: numerator, norm, their quotient, at most two factors, at most two products: 7 of 2^-53.
// Factors are between 2^-64 and 2^64 and entries of a rotation that are not zero at least 2^-62, so nothing underflows.
PosedDoubles::PosedDoubles(const PoseFactors& pose) {
  map = cofactors = rotation_in_doubles(pose.rotation);
  if (pose.scaled) {
    std::array<double, 3> s;
    for (std::size_t k = 0; k < 3; ++k) s[k] = exact::round_to_double(exact::BigRational(pose.num[k], pose.den[k]));
    map = columns_scaled(map, s);
    cofactors = columns_scaled(cofactors, {s[1] * s[2], s[2] * s[0], s[0] * s[1]});
    determinant = s[0] * s[1] * s[2];
  }
  exponent = exponent_of(map);
  cofactors_exponent = exponent_of(cofactors);
  map = scaled_by_power(map, -exponent);
  cofactors = scaled_by_power(cofactors, -cofactors_exponent);
  determinant = std::ldexp(determinant, -3 * exponent);
}

}  // namespace dymsum::spatial
