#include "spatial/motion/axis_turn.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "exact/big.h"

namespace dymsum::spatial {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::RootValue;
using exact::Terms;
using exact::Vector3;

namespace {

BigInteger whole(std::int64_t v) { return BigInteger(v); }

/// u, v of the quaternion (u, v axis).
std::array<BigInteger, 2> quaternion(const ChartPosition& position, std::int64_t square) {
  const BigInteger n = numerator(position.t), d = denominator(position.t);
  if (position.chart == 0) return {d, n};
  return {BigInteger(-whole(square) * n), d};
}

}  // namespace

RotationCircle::RotationCircle(TurnAxis axis) : axis_(axis) {
  square_ = 0;
  for (const std::int32_t a : axis_) square_ += static_cast<std::int64_t>(a) * a;
  length_ = std::sqrt(static_cast<double>(square_));
  divisor_ = {1, 0, whole(square_)};
  weight_ = {divisor_, exact::Terms{whole(square_), 0, BigInteger(whole(square_) * square_)}};
}

ChartPosition RotationCircle::position(const AxisTurn& turn) const {
  if (turn.is_half_turn()) return {1, 0};
  const BigRational t = exact::exact_value(turn.t());
  if (abs(t) <= reach(0)) return {0, t};
  return {1, BigRational(-1 / (t * square_))};
}

AxisTurn RotationCircle::turn(const ChartPosition& position) const {
  if (position.chart == 0) return AxisTurn::of(exact::to_rational(position.t));
  if (position.t.is_zero()) return AxisTurn::half_turn();
  return AxisTurn::of(exact::to_rational(BigRational(-1 / (position.t * square_))));
}

exact::BigRational RotationCircle::reach(int chart) const {
  const auto least = static_cast<std::int64_t>(std::ceil(length_));
  return chart == 0 ? BigRational(1, least) : BigRational(least, square_);
}

double RotationCircle::radians(int chart, double t) const {
  return 2 * std::atan(length_ * t) + (chart == 0 ? 0 : std::numbers::pi);
}

ExactPose RotationCircle::pose(const ChartPosition& position) const {
  const auto [u, v] = quaternion(position, square_);
  const BigInteger uu = u * u, uv = 2 * u * v, vv = v * v;
  ExactPose pose;
  pose.den = uu + vv * square_;
  BigInteger common = pose.den;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      BigInteger m = 2 * vv * axis_[r] * axis_[c];
      if (r == c) m += uu - vv * square_;
      else if ((r + 1) % 3 == c) m -= uv * axis_[(r + 2) % 3];
      else m += uv * axis_[(r + 1) % 3];
      pose.matrix[3 * r + c] = m;
      common = gcd(common, m);
    }
  pose.den /= common;
  for (BigInteger& m : pose.matrix) m /= common;
  return pose;
}

Vector3<RootValue> RotationCircle::turned(int chart, const Vector3<Big>& x, const exact::RootPoint* at) const {
  const Vector3<Big> a{Big::from_int64(axis_[0]), Big::from_int64(axis_[1]), Big::from_int64(axis_[2])};
  const auto side = exact::cross(a, x);
  const Big along = exact::dot(a, x), two = Big::from_int64(2), square = Big::from_int64(square_);
  // Chart 0: x + 2 t (a x x) + t^2 (2 a (a . x) - |a|^2 x). Chart 1, with |a|^2 divided out:
  // (2 a (a . x) - |a|^2 x) / |a|^2 - 2 t (a x x) + t^2 |a|^2 x; times |a|^2, as the weight is.
  const auto row = [&](const Big& xi, const Big& ai, const Big& si) {
    const Big last = two * ai * along - square * xi;
    Terms terms = chart == 0 ? Terms{xi.value(), BigInteger(2 * si.value()), last.value()}
                             : Terms{last.value(), BigInteger(-2 * square_ * si.value()),
                                     BigInteger(whole(square_) * square_ * xi.value())};
    while (!terms.empty() && terms.back().is_zero()) terms.pop_back();
    return RootValue(std::move(terms), at);
  };
  return {row(x.x, a.x, side.x), row(x.y, a.y, side.y), row(x.z, a.z, side.z)};
}

}  // namespace dymsum::spatial

namespace dymsum {

Result<AxisTurn> AxisTurn::nearest(const TurnAxis& axis, double radians) {
  if (!std::isfinite(radians)) return Error{ErrorCode::bad_rotation, "the angle is not finite", {}};
  if (axis == TurnAxis{}) return Error{ErrorCode::bad_rotation, "the axis is zero", {}};
  const std::int32_t divisor = std::gcd(std::gcd(axis[0], axis[1]), axis[2]);
  const spatial::RotationCircle circle({axis[0] / divisor, axis[1] / divisor, axis[2] / divisor});
  const double turn = std::remainder(radians, 2 * std::numbers::pi);
  if (std::abs(turn) == std::numbers::pi) return half_turn();
  const int chart = std::abs(turn) > std::numbers::pi / 2 ? 1 : 0;
  const double half = chart == 0 ? turn / 2 : (turn > 0 ? turn - std::numbers::pi : turn + std::numbers::pi) / 2;
  double t = std::tan(half);
  if (std::abs(turn) == std::numbers::pi / 2) t = turn > 0 ? 1 : -1;
  if (std::abs(turn) != std::numbers::pi / 2 || circle.square() != 1) t /= circle.length();
  const double grid = std::ldexp(1, 44);
  t = std::nearbyint(t * grid) / grid;
  return circle.turn({chart, exact::exact_value(t)});
}

double AxisTurn::radians(const TurnAxis& axis) const {
  if (half_turn_) return std::numbers::pi;
  const std::int32_t divisor = std::max(1, std::gcd(std::gcd(axis[0], axis[1]), axis[2]));
  double square = 0;
  for (const std::int32_t a : axis) square += static_cast<double>(a / divisor) * (a / divisor);
  return 2 * std::atan(t_.to_double() * std::sqrt(square));
}

}  // namespace dymsum
