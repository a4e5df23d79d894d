#include "spatial/motion/rotation_forms.h"

#include <algorithm>

namespace dymsum::spatial {

using exact::Big;
using exact::RootValue;
using exact::Vector3;

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
