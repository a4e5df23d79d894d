#include "dymsum/rotation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "exact/int.h"

namespace dymsum {
namespace {

using exact::i128;
constexpr std::int64_t kMost = std::int64_t{1} << Rotation::kBits;

// Half turns have two quaternions of opposite sign like all rotations: the first component that is not zero is made
// positive.
void make_leading_positive(std::array<i128, 4>& q) {
  for (const i128 c : q) {
    if (c == 0) continue;
    if (c < 0)
      for (i128& d : q) d = -d;
    return;
  }
}

i128 magnitude(const std::array<i128, 4>& q) {
  i128 most = 0;
  for (const i128 c : q) most = std::max(most, c < 0 ? -c : c);
  return most;
}

i128 gcd(i128 a, i128 b) {
  while (b != 0) {
    const i128 r = a % b;
    a = b;
    b = r;
  }
  return a < 0 ? -a : a;
}

void reduce(std::array<i128, 4>& q) {
  i128 d = 0;
  for (const i128 c : q) d = gcd(d, c);
  if (d > 1)
    for (i128& c : q) c /= d;
}

// Rounds to components of at most kMost: each changes by at most one half after a scaling that keeps the direction.
std::array<i128, 4> rounded(std::array<i128, 4> q) {
  const i128 most = magnitude(q);
  if (most <= kMost) return q;
  for (i128& c : q) {
    const bool negative = c < 0;
    // |c| <= most < 2^64 here: products of two quaternions have components of at most 2^62.
    const i128 scaled = ((negative ? -c : c) * kMost + most / 2) / most;
    c = negative ? -scaled : scaled;
  }
  reduce(q);
  return q;
}

Result<Rotation> make(std::array<i128, 4> q) {
  make_leading_positive(q);
  return Rotation::of(static_cast<std::int64_t>(q[0]), static_cast<std::int64_t>(q[1]), static_cast<std::int64_t>(q[2]),
                      static_cast<std::int64_t>(q[3]));
}

}  // namespace

Result<Rotation> Rotation::of(std::int64_t w, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::array<i128, 4> q{w, x, y, z};
  if (magnitude(q) == 0) return Error{ErrorCode::bad_rotation, "a quaternion of zeros is no rotation", {}};
  reduce(q);
  if (magnitude(q) > kMost) return Error{ErrorCode::bad_rotation, "a component of the quaternion is beyond 2^30", {}};
  make_leading_positive(q);
  Rotation r;
  for (int i = 0; i < 4; ++i) r.q_[i] = static_cast<std::int64_t>(q[i]);
  return r;
}

Result<Rotation> Rotation::nearest(double w, double x, double y, double z) {
  const double most = std::max({std::abs(w), std::abs(x), std::abs(y), std::abs(z)});
  const std::array<double, 4> d{w, x, y, z};
  if (!(most > 0) || !std::all_of(d.begin(), d.end(), [](double c) { return std::isfinite(c); }))
    return Error{ErrorCode::bad_rotation, "a rotation needs finite numbers that are not all zero", {}};
  std::array<i128, 4> q;
  for (int i = 0; i < 4; ++i)
    q[i] = static_cast<std::int64_t>(std::nearbyint(d[i] / most * static_cast<double>(kMost)));
  reduce(q);
  return make(q);
}

Result<Rotation> Rotation::about(Point3 axis, double radians) {
  const double most = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  if (!(most > 0) || !std::isfinite(axis.x) || !std::isfinite(axis.y) || !std::isfinite(axis.z) ||
      !std::isfinite(radians))
    return Error{ErrorCode::bad_rotation, "a rotation needs an axis that is not zero, and finite numbers", {}};
  const double x = axis.x / most, y = axis.y / most, z = axis.z / most;
  const double c = std::cos(radians / 2), s = std::sin(radians / 2) / std::sqrt(x * x + y * y + z * z);
  return nearest(c, s * x, s * y, s * z);
}

Rotation operator*(const Rotation& a, const Rotation& b) {
  const auto [aw, ax, ay, az] = std::array<i128, 4>{a.q_[0], a.q_[1], a.q_[2], a.q_[3]};
  const auto [bw, bx, by, bz] = std::array<i128, 4>{b.q_[0], b.q_[1], b.q_[2], b.q_[3]};
  std::array<i128, 4> q{aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                        aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw};
  reduce(q);
  return *make(rounded(q));
}

Rotation Rotation::inverse() const { return *of(q_[0], -q_[1], -q_[2], -q_[3]); }

std::array<std::int64_t, 9> Rotation::matrix() const {
  const auto [w, x, y, z] = q_;
  return {w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
          2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
          2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
}

std::int64_t Rotation::norm() const {
  const auto [w, x, y, z] = q_;
  return w * w + x * x + y * y + z * z;
}

double Rotation::angle() const {
  const double v =
      std::sqrt(double(q_[1]) * double(q_[1]) + double(q_[2]) * double(q_[2]) + double(q_[3]) * double(q_[3]));
  return 2 * std::atan2(v, std::abs(double(q_[0])));
}

}  // namespace dymsum
