#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dymsum/convex_polygon_sum.h"
#include "exact/int.h"

namespace dymsum {
namespace {

using exact::i128;
constexpr std::int64_t kMost = std::int64_t{1} << PlanarRotation::kBits;

PlanarRotation make(std::int64_t u, std::int64_t v) { return *PlanarRotation::of(u, v); }

/// To components of at most kMost, each rounded by at most one half: the half angle turns by at most 2^-30.5.
std::array<std::int64_t, 2> rounded(i128 u, i128 v) {
  const i128 most = std::max(u < 0 ? -u : u, v < 0 ? -v : v);
  if (most <= kMost) return {static_cast<std::int64_t>(u), static_cast<std::int64_t>(v)};
  const auto scaled = [&](i128 c) {
    return static_cast<std::int64_t>((2 * c * kMost + (c < 0 ? -most : most)) / (2 * most));
  };
  return {scaled(u), scaled(v)};
}

}  // namespace

Result<PlanarRotation> PlanarRotation::of(std::int64_t u, std::int64_t v) {
  if (u == 0 && v == 0) return Error{Code::bad_rotation, "zero is no rotation", {}};
  const std::int64_t divisor = std::gcd(u, v), turn = u < 0 || (u == 0 && v < 0) ? -1 : 1;
  u = turn * (u / divisor);
  v = turn * (v / divisor);
  if (u > kMost || v > kMost || v < -kMost)
    return Error{Code::bad_rotation, "a component of the rotation is beyond 2^30", {}};
  PlanarRotation r;
  r.z_ = {u, v};
  return r;
}

Result<PlanarRotation> PlanarRotation::nearest(double radians) {
  if (!std::isfinite(radians)) return Error{Code::bad_rotation, "an angle has to be finite", {}};
  const double u = std::cos(radians / 2), v = std::sin(radians / 2), most = std::max(std::abs(u), std::abs(v));
  const auto snap = [&](double c) {
    return static_cast<std::int64_t>(std::nearbyint(c / most * static_cast<double>(kMost)));
  };
  return of(snap(u), snap(v));
}

PlanarRotation operator*(const PlanarRotation& a, const PlanarRotation& b) {
  const i128 au = a.z_[0], av = a.z_[1], bu = b.z_[0], bv = b.z_[1];
  // 2^61, so 64 bits hold them.
  const auto u = static_cast<std::int64_t>(au * bu - av * bv), v = static_cast<std::int64_t>(au * bv + av * bu);
  const std::int64_t divisor = std::gcd(u, v);
  const auto [x, y] = rounded(u / divisor, v / divisor);
  return make(x, y);
}

}  // namespace dymsum
