#include "spatial/motion/pose_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::spatial {

namespace {

/// conj(a) b. The products' terms are each rounded by 2^-53 of at most |a| |b|.
UnitQuaternion quotient(double aw, Vec3 a, double bw, Vec3 b) {
  return {aw * bw + dot(a, b), aw * b - bw * a - cross(a, b)};
}

}  // namespace

Vec3 scale_factors(const SolidPose& pose) {
  return {pose.scale[0].approx(), pose.scale[1].approx(), pose.scale[2].approx()};
}

double angle_of_scaling(const Vec3& from, const Vec3& to) {
  const double r[3] = {to.x / from.x, to.y / from.y, to.z / from.z};
  const auto [low, high] = std::minmax_element(r, r + 3);
  if (*low == *high) return 0;
  // A diagonal map of ratio k between its largest and its smallest factor turns by asin((k - 1) / (k + 1)) at most, and
  // so does its inverse, by which normals go.
  return std::asin(std::min(1.0, (*high - *low) / (*high + *low) + 0x1p-48)) + 0x1p-48;
}

UnitQuaternion relative_rotation(const Rotation& p, const Rotation& q) {
  const auto& a = p.quaternion();
  const auto& b = q.quaternion();
  const auto number = [](std::int64_t c) { return static_cast<double>(c); };
  const UnitQuaternion r = quotient(number(a[0]), {number(a[1]), number(a[2]), number(a[3])}, number(b[0]),
                                    {number(b[1]), number(b[2]), number(b[3])});
  const double size = std::sqrt(r.w * r.w + dot(r.v, r.v));
  return {r.w / size, (1 / size) * r.v};
}

Mat3 matrix_of(const UnitQuaternion& q) {
  const double w = q.w, x = q.v.x, y = q.v.y, z = q.v.z;
  return {Vec3{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
          Vec3{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
          Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
}

double angle_between(const UnitQuaternion& a, const UnitQuaternion& b) {
  const UnitQuaternion d = quotient(a.w, a.v, b.w, b.v);
  return std::min(std::numbers::pi, 2 * std::atan2(length(d.v), std::abs(d.w))) + 0x1p-44;
}

}  // namespace dymsum::spatial
