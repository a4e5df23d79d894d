#include "cspace/events/exact_position.h"

#include <algorithm>

#include "exact/rounding_bound.h"

namespace dymsum::planar {

using exact::Polynomial;

namespace {

// The least sine for crossings in doubles: they err by what the side and the cross product do and the angle moves them
// by, over it.
constexpr double kLeastSine = 0x1p-4;
static_assert((kTurnedSide + kTurnedCross + 4 * 0x1p-49) / kLeastSine + kTurnedPosition + 0x1p-49 <=
              SignsAt::kCrossingNear);
// The error of the cross or scalar product of two edges at the heading is this times their lengths: the form
// (kTurnedCross, and as much for two directions), and what an angle within 2^-49 turns it by.
constexpr double kProduct = exact::rounding_bound(56 + 2 * 16, 8192);

Polynomial one() { return Polynomial({exact::Big(exact::BigInteger(1))}); }

Fraction half_of_sum(const Fraction& x, const Fraction& y) {
  const Polynomial den = product(x.den, y.den);
  return {sum_of(product(x.num, y.den), product(y.num, x.den), 1), sum_of(den, den, 1)};
}

// The heading of t within 2^-60.
Heading heading_of(exact::RootBracket& bracket, int chart) {
  bracket.refine_to(60);
  const double t = exact::double_bounds(bracket.low().value()).first, sign = chart == 0 ? 1 : -1;
  return {sign * (1 - t * t) / (1 + t * t), sign * 2 * t / (1 + t * t)};
}

/// p at a dyadic number x of [-1, 1], and a bound on what its values within 2^-bits of x differ from that by.
struct ValueNear {
  exact::BigInteger value, error;  ///< times 2^(kMaxDegree shift of x)
  ValueNear(const Polynomial& p, const exact::DyadicNumber& x, unsigned bits) {
    const int degree = std::max(p.degree(), 0);
    value = p.value_at_dyadic(x.numerator, x.shift)
            << (static_cast<unsigned>(Polynomial::kMaxDegree - degree) * x.shift);
    for (int k = 1; k <= degree; ++k) error += abs(p[k].value()) * k;
    error <<= Polynomial::kMaxDegree * x.shift;
    error >>= bits;
    error += 1;
  }
};

}  // namespace

Polynomial product(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero() || q.is_zero()) return {};
  std::vector<exact::Big> c(static_cast<std::size_t>(p.degree() + q.degree()) + 1);
  for (int i = 0; i <= p.degree(); ++i)
    for (int j = 0; j <= q.degree(); ++j) {
      exact::Big& to = c[static_cast<std::size_t>(i + j)];
      to = to + exact::Big(exact::BigInteger(p[i].value() * q[j].value()));
    }
  return Polynomial(std::move(c));
}

Polynomial sum_of(const Polynomial& p, const Polynomial& q, int sign) {
  std::vector<exact::Big> c(static_cast<std::size_t>(std::max({p.degree(), q.degree(), 0})) + 1);
  for (int i = 0; i < static_cast<int>(c.size()); ++i)
    c[static_cast<std::size_t>(i)] = p[i] + exact::Big(exact::BigInteger(sign * q[i].value()));
  return Polynomial(std::move(c));
}

SignsAt::SignsAt(const TurningForms& forms, const ExactAngle& angle)
    : forms_(forms), angle_(angle), bracket_(angle.t.bracket()), heading_(heading_of(bracket_, angle.chart)) {}

int SignsAt::compare(const Fraction& x, const Fraction& y) const {
  return sign(sum_of(product(x.num, y.den), product(y.num, x.den), -1)) * sign(x.den) * sign(y.den);
}

// It ends, as the denominator is not 0.
double SignsAt::quotient(const Polynomial& num, const Polynomial& den) const {
  for (unsigned bits = 128;; bits *= 2) {
    bracket_.refine_to(bits);
    const ValueNear n(num, bracket_.low(), bits), d(den, bracket_.low(), bits);
    const exact::BigInteger size = abs(d.value);
    if (!bracket_.is_point() && ((n.error << 52) > size || (d.error << 52) > size)) continue;
    return exact::round_to_double(exact::ratio(exact::Big(n.value), exact::Big(d.value)));
  }
}

// Rounding lets a crossing in doubles err along the first segment by less than 2^-45 of the span over the sine
// (side_error, over the lengths), and by 2^-49 (1 + 4 / sine) by the angle.
std::optional<Point> SignsAt::near(const ExactPosition::Simple& z) const {
  if (!z.crossing) return forms_.position(z.corner, heading_);
  const Pair start = TurningForms::start(z.a);
  const double cross = forms_.cross(z.a, z.b).at(heading_);
  const bool clear = std::abs(cross) >= kLeastSine * forms_.length1(z.a) * forms_.length1(z.b);
  const double t =
      clear ? forms_.side(z.b, start).at(heading_) / cross
            : quotient(forms_.exact_side(z.b, start, angle_.chart), forms_.exact_cross(z.a, z.b, angle_.chart));
  // The t of a short segment may err by more than it is long.
  const double slack = kNear * forms_.span() / forms_.length1(z.a);
  if (!(t > -slack && t < 1 + slack)) return std::nullopt;
  const Point from = forms_.position(start, heading_), d = forms_.direction(z.a, heading_);
  return Point{from.x + t * d.x, from.y + t * d.y};
}

std::optional<Point> SignsAt::near(const ExactPosition& z) const {
  const std::optional<Point> first = near(z.first);
  if (!z.second || !first) return first;
  const std::optional<Point> second = near(*z.second);
  if (!second) return second;
  return Point{(first->x + second->x) / 2, (first->y + second->y) / 2};
}

// A crossing is start_a + (side(b, start_a) / (a x b)) d_a.
Fraction SignsAt::side(const WalkSegment& s, const ExactPosition::Simple& z) const {
  const int chart = angle_.chart;
  if (!z.crossing) return {forms_.exact_side(s, z.corner, chart), one()};
  const Pair from = TurningForms::start(z.a);
  const Polynomial ab = forms_.exact_cross(z.a, z.b, chart), fraction = forms_.exact_side(z.b, from, chart);
  return {
      sum_of(product(forms_.exact_side(s, from, chart), ab), product(fraction, forms_.exact_cross(s, z.a, chart)), 1),
      ab};
}

Fraction SignsAt::along(const WalkSegment& s, const ExactPosition::Simple& z) const {
  const int chart = angle_.chart;
  const Pair start = TurningForms::start(s);
  if (!z.crossing) return {forms_.exact_along(s, start, z.corner, chart), one()};
  const Pair from = TurningForms::start(z.a);
  const Polynomial ab = forms_.exact_cross(z.a, z.b, chart), fraction = forms_.exact_side(z.b, from, chart);
  const Polynomial dot = forms_.exact_along(s, from, forms_.end(z.a), chart);
  return {sum_of(product(forms_.exact_along(s, start, from, chart), ab), product(fraction, dot), 1), ab};
}

Fraction SignsAt::side(const WalkSegment& s, const ExactPosition& z) const {
  return z.second ? half_of_sum(side(s, z.first), side(s, *z.second)) : side(s, z.first);
}

Fraction SignsAt::along(const WalkSegment& s, const ExactPosition& z) const {
  return z.second ? half_of_sum(along(s, z.first), along(s, *z.second)) : along(s, z.first);
}

Fraction SignsAt::length(const WalkSegment& s) const {
  return {forms_.exact_along(s, TurningForms::start(s), forms_.end(s), angle_.chart), one()};
}

int SignsAt::side_sign(const WalkSegment& s, const ExactPosition& z, Point near) const {
  const Point from = forms_.position(TurningForms::start(s), heading_), d = forms_.direction(s, heading_);
  const double value = d.x * (near.y - from.y) - d.y * (near.x - from.x);
  if (std::abs(value) > kNear * forms_.length1(s) * forms_.span()) return value > 0 ? 1 : -1;
  return sign(side(s, z));
}

bool SignsAt::within(const WalkSegment& s, const ExactPosition& z, Point near) const {
  const Point e = forms_.edge(s.side, s.edge);
  const double value = along_near(s, near), end = e.x * e.x + e.y * e.y,
               error = 2 * kNear * forms_.length1(s) * forms_.span();
  if (value < -error || value > end + error) return false;
  if (value > error && value < end - error) return true;
  const Fraction at = along(s, z);
  return sign(at) >= 0 && compare(at, length(s)) <= 0;
}

int SignsAt::order(const WalkSegment& s, const ExactPosition& y, Point y_near, const ExactPosition& z,
                   Point z_near) const {
  const double d = along_near(s, y_near) - along_near(s, z_near);
  if (std::abs(d) > 2 * kNear * forms_.length1(s) * forms_.span()) return d > 0 ? 1 : -1;
  return compare(along(s, y), along(s, z));
}

bool SignsAt::same(const ExactPosition::Simple& y, const ExactPosition& z) const {
  if (y.crossing) return sign(side(y.a, z)) == 0 && sign(side(y.b, z)) == 0;
  // An edge that starts there; a single point has none.
  const WalkSegment s =
      forms_.is_point(0, y.corner.p) ? WalkSegment{1, y.corner.q, y.corner.p} : WalkSegment{0, y.corner.p, y.corner.q};
  return sign(side(s, z)) == 0 && sign(along(s, z)) == 0;
}

// Whether y and z are the same. Requires that y is no midpoint.
bool SignsAt::same(const ExactPosition& y, const ExactPosition& z) const { return same(y.first, z); }

int SignsAt::cross(const WalkSegment& d, const WalkSegment& e) const {
  const double value = forms_.cross(d, e).at(heading_);
  if (std::abs(value) > kProduct * forms_.length1(d) * forms_.length1(e)) return value > 0 ? 1 : -1;
  return sign(forms_.exact_cross(d, e, angle_.chart));
}

int SignsAt::dot(const WalkSegment& d, const WalkSegment& e) const {
  const Point u = forms_.direction(d, heading_), v = forms_.direction(e, heading_);
  const double value = u.x * v.x + u.y * v.y;
  if (std::abs(value) > kProduct * forms_.length1(d) * forms_.length1(e)) return value > 0 ? 1 : -1;
  return sign(forms_.exact_along(d, TurningForms::start(e), forms_.end(e), angle_.chart));
}

}  // namespace dymsum::planar
