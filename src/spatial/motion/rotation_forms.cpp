#include "spatial/motion/rotation_forms.h"

#include <algorithm>
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

namespace dymsum::spatial {

RotatingPair::RotatingPair(const Mesh& p, const Mesh& q, const TurnAxis& axis, int which)
    : pair(solid_pair(p, q)), circle(axis), turning(which) {
  double most = 0;
  for (const SolidOperand* solid : {&pair.p, &pair.q})
    for (const Point3& v : solid->vertices) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  unit = most == 0 ? 1 : std::ldexp(1.0, -std::ilogb(most) - 1);
  for (int op = 0; op < 2; ++op)
    for (const Point3& v : operand(op).vertices) positions[op].push_back({v.x * unit, v.y * unit, v.z * unit});
}

Vector3<Big> RotatingPair::direction(int op, std::uint32_t from, std::uint32_t to) const {
  return grid(op).position<Big>(to) - grid(op).position<Big>(from);
}

bool RotatingPair::along_axis(int op, std::uint32_t from, std::uint32_t to) const {
  const auto big = [](std::int32_t c) { return Big::from_int64(c); };
  const TurnAxis& a = circle.axis();
  const auto c = exact::cross(direction(op, from, to), Vector3<Big>{big(a[0]), big(a[1]), big(a[2])});
  return sign(c.x) == 0 && sign(c.y) == 0 && sign(c.z) == 0;
}

JetFrame::JetFrame(const RotatingPair& pair, double midpoint, double half) : pair_(pair), half_(half) {
  const double c = std::cos(midpoint), s = std::sin(midpoint), l = pair.circle.length();
  const TurnAxis& axis = pair.circle.axis();
  const Vec3 a{axis[0] / l, axis[1] / l, axis[2] / l};
  const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double along[3] = {a.x, a.y, a.z};
  for (int r = 0; r < 3; ++r) {
    const Vec3 row = cross(unit[r], a);  // unit . (a x v) = (unit x a) . v
    matrix_[r] = c * unit[r] + s * row + (1 - c) * along[r] * a;
    slope_[r] = half * ((-s) * unit[r] + c * row + s * along[r] * a);
  }
}

JetFrame::Vector JetFrame::placed(int op, Vec3 v, double error) const {
  const double size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  if (op != pair_.turning) {
    const double rest = size * 0x1p-50 + error;
    return {{v.x, 0, rest}, {v.y, 0, rest}, {v.z, 0, rest}};
  }
  // The middle is off by 2^-46, entries of the matrix by less than 2^-48; beyond the slope angles turn by half^2 / 2.
  const double rest = size * (half_ * half_ * 0.5 * (1 + 0x1p-40) + 0x1p-44) + error;
  const Vec3 at = matrix_ * v, direction = slope_ * v;
  return {{at.x, direction.x, rest}, {at.y, direction.y, rest}, {at.z, direction.z, rest}};
}

JetFrame::Vector JetFrame::normal(int op, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const std::vector<Vec3>& at = pair_.positions[op];
  const Vec3 u = at[b] - at[a], v = at[c] - at[a];
  const auto size = [](Vec3 w) { return std::abs(w.x) + std::abs(w.y) + std::abs(w.z); };
  return placed(op, cross(u, v), size(u) * size(v) * 0x1p-49);
}

Box JetFrame::box(SumPoint v) const {
  const Vector at = position(0, v.p) + position(1, v.q);
  Box box;
  box.add(Vec3{at.x.low(), at.y.low(), at.z.low()}), box.add(Vec3{at.x.high(), at.y.high(), at.z.high()});
  return box;
}

namespace {

/// All t from `low` to `high`.
void set_between(FineJet& t, const exact::BigRational& low, const exact::BigRational& high) {
  const exact::BigRational midpoint = (low + high) / 2;
  const double first = exact::round_to_double(midpoint),
               second = exact::round_to_double(midpoint - exact::exact_value(first));
  const exact::BigRational at = exact::exact_value(first) + exact::exact_value(second);
  const double half = exact::round_to_double(std::max<exact::BigRational>(high - at, at - low)) * (1 + 0x1p-50);
  t = {{first, second}, half, 0};
}
void set_between(exact::WideInterval& t, const exact::BigRational& low, const exact::BigRational& high) {
  constexpr int kBits = exact::WideInterval::kFractionBits + 4;
  const exact::BigRational scale(exact::BigInteger(1) << kBits), midpoint = (low + high) / 2 * scale,
                                                                 half = (high - low) / 2 * scale;
  // Either quotient is cut off by less than 1.
  const exact::BigInteger at = numerator(midpoint) / denominator(midpoint),
                          error = numerator(half) / denominator(half) + 2;
  t = exact::WideInterval::around(at, low == high && denominator(midpoint) == 1 ? exact::BigInteger(0) : error, -kBits);
}

}  // namespace

template <class N>
PreciseFrame<N>::PreciseFrame(const RotatingPair& pair, int chart, const exact::BigRational& low,
                              const exact::BigRational& high)
    : pair_(pair), chart_(chart) {
  set_between(t_, low, high);
  const TurnAxis& axis = pair.circle.axis();
  axis_ = {N::of(axis[0]), N::of(axis[1]), N::of(axis[2])};
  square_ = N::of(static_cast<double>(pair.circle.square()));
  weight_ = N::of(1) + square_ * (t_ * t_);
  if (chart == 1) weight_ = square_ * weight_;
}

template <class N>
typename PreciseFrame<N>::Vector PreciseFrame<N>::difference(Vec3 from, Vec3 to) {
  return {N::difference(from.x, to.x), N::difference(from.y, to.y), N::difference(from.z, to.z)};
}

// The vector that RotationCircle::turned makes.
template <class N>
typename PreciseFrame<N>::Vector PreciseFrame<N>::placed(int op, const Vector& v, bool weighted) const {
  if (op != pair_.turning) return weighted ? Vector{weight_ * v.x, weight_ * v.y, weight_ * v.z} : v;
  const Vector side = cross(axis_, v);
  const N along = dot(axis_, v), two = N::of(2);
  const auto row = [&](const N& x, const N& a, const N& s) {
    const N last = two * (a * along) - square_ * x;
    return chart_ == 0 ? x + t_ * (two * s + t_ * last) : last + square_ * (t_ * (square_ * (t_ * x) - two * s));
  };
  return {row(v.x, axis_.x, side.x), row(v.y, axis_.y, side.y), row(v.z, axis_.z, side.z)};
}

template <class N>
typename PreciseFrame<N>::Vector PreciseFrame<N>::normal(int op, std::uint32_t a, std::uint32_t b,
                                                         std::uint32_t c) const {
  const std::vector<Vec3>& at = pair_.positions[op];
  return placed(op, cross(difference(at[a], at[b]), difference(at[a], at[c])), false);
}

template class PreciseFrame<FineJet>;
template class PreciseFrame<exact::WideInterval>;

/// The value of a form of degree at most 2 at n / d, times d^2.
RootValue PolynomialFrame::value(exact::Terms terms) const {
  if (!t_ || terms.empty()) return RootValue(std::move(terms), at_);
  const exact::BigInteger n = numerator(*t_), d = denominator(*t_);
  exact::BigInteger value = terms[0] * d * d;
  if (terms.size() > 1) value += terms[1] * n * d;
  if (terms.size() > 2) value += terms[2] * n * n;
  return RootValue(Big(std::move(value)));
}

PolynomialFrame::Vector PolynomialFrame::placed(int op, const Vector3<Big>& v, bool weighted) const {
  const auto valued = [&](const RootValue& c) { return value(c.terms()); };
  if (op == pair_.turning) {
    const Vector turned = pair_.circle.turned(chart_, v, at_);
    return t_ ? Vector{valued(turned.x), valued(turned.y), valued(turned.z)} : turned;
  }
  const auto fixed = [&](const Big& c) {
    if (sign(c) == 0) return RootValue(exact::Terms{}, at_);
    return weighted ? value(exact::product_of(pair_.circle.weight(chart_), {c.value()}))
                    : RootValue(exact::Terms{c.value()}, at_);
  };
  return {fixed(v.x), fixed(v.y), fixed(v.z)};
}

PolynomialFrame::Vector PolynomialFrame::normal(int op, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return placed(op, exact::cross(pair_.direction(op, a, b), pair_.direction(op, a, c)), false);
}

}  // namespace dymsum::spatial
