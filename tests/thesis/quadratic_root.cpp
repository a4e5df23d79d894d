#include "thesis/quadratic_root.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "exact/rounding_bound.h"

namespace dymsum::exact {
namespace {

using boost::multiprecision::msb;

/// mantissa 2^exponent, 1/2 <= |mantissa| < 1 or zero: a double with the exponents that large integers need.
struct ScaledCoefficient {
  double mantissa = 0;
  long exponent = 0;
};

ScaledCoefficient normalised(double mantissa, long exponent) {
  int more = 0;
  mantissa = std::frexp(mantissa, &more);
  return {mantissa, exponent + more};
}

/// Relative error at most 2^-52: all but 120 leading bits are cut (2^-119), the rest is rounded (2^-53).
ScaledCoefficient scaled(const Big& v) {
  if (sign(v) == 0) return {};
  const BigInteger magnitude = boost::multiprecision::abs(v.value());
  const long cut = std::max(0L, static_cast<long>(msb(magnitude)) - 120);
  const double kept = to_double(Big(BigInteger(magnitude >> static_cast<unsigned>(cut))));
  return normalised(sign(v) * kept, cut);
}

/// x 2^by, zero far below the doubles.
double times_power(ScaledCoefficient x, long by) {
  const long e = x.exponent + by;
  return e < -2000 ? 0 : std::ldexp(x.mantissa, static_cast<int>(e));
}

/// The sum of two numbers of the same sign: relative error the larger one's plus 2^-53.
ScaledCoefficient plus_same_sign(ScaledCoefficient a, ScaledCoefficient b) {
  if (a.mantissa == 0) return b;
  if (b.mantissa == 0) return a;
  const long e = std::max(a.exponent, b.exponent);
  return normalised(times_power(a, -e) + times_power(b, -e), e);
}

/// Relative error: half of the argument's, plus 2^-53.
ScaledCoefficient square_root(ScaledCoefficient a) {
  if (a.exponent % 2 != 0) a = {2 * a.mantissa, a.exponent - 1};
  return normalised(std::sqrt(a.mantissa), a.exponent / 2);
}

// Where doubles have decided. A term p_k u^i v^j has factors with errors 2^-51, 2^-49, 2^-49 and four roundings
// together with the sums: 4 + 2 * 16 + 4 units of the sum of magnitudes of the terms at most; what was lost below the
// doubles is below 2^-990 with components of at most 2.
constexpr double kTermError = rounding_bound(40, 64), kUnderflowLoss = 0x1p-980;

/// The sign of a sum whose terms have these magnitudes together, if doubles decide.
std::optional<int> filtered(double value, double magnitudes) {
  const double error = kTermError * magnitudes + kUnderflowLoss;
  if (value > error) return 1;
  if (value < -error) return -1;
  return std::nullopt;
}

int sign_of(const Slope slope) { return static_cast<int>(slope); }

/// q'(t), as a form that has its sign at finite points: u^2 q'(v / u).
Quadratic derivative(const Quadratic& q) { return {q[1], q[2] + q[2], Big()}; }

/// compare_answer for finite a and b without the filter. A polynomial with positive leading coefficient is negative
/// between its roots and falls before the middle of them.
int exact_compare(const QuadraticRoot& a, const QuadraticRoot& b) {
  const Quadratic& q = b.form();
  const int leading = sign(q[2]);
  if (leading == 0) return sign_at(a, q) * sign(q[1]);
  const int side = leading * sign_at(a, derivative(q));  // of the midpoint of b's two roots that a lies on
  if (b.slope() == Slope::touching) return side;
  const int value = leading * sign_at(a, q);
  if (sign_of(b.slope()) * leading > 0) return value < 0 || side < 0 ? -1 : value;
  return value < 0 || side > 0 ? 1 : -value;
}

/// 0 for t >= 0, 1 for infinity, 2 for t < 0.
int turn_class(const QuadraticRoot& r, bool& exactly) {
  if (r.approx()[0] > kUnderflowLoss && std::abs(r.approx()[1]) > kUnderflowLoss) return r.approx()[1] > 0 ? 0 : 2;
  exactly = true;
  if (r.is_infinite()) return 1;
  return sign_at(r, {Big(), Big::from_int64(1), Big()}) >= 0 ? 0 : 2;
}

}  // namespace

Quadratic::Quadratic(Big c0, Big c1, Big c2) : c_{std::move(c0), std::move(c1), std::move(c2)} {
  std::array<ScaledCoefficient, 3> d;
  long top = -1;
  for (int k = 0; k < 3; ++k) {
    d[k] = scaled(c_[k]);
    if (d[k].mantissa != 0) top = std::max(top, d[k].exponent);
  }
  for (int k = 0; k < 3; ++k) approx_[k] = times_power(d[k], 1 - top);
}

Big Quadratic::discriminant() const { return c_[1] * c_[1] - shift_left<2>(c_[0] * c_[2]); }

/// The root is both (2 c2 : -c1 + s sqrt D) and (-c1 - s sqrt D : 2 c0), s the slope: at t = v / u the derivative c1 +
/// 2 c2 t is s sqrt D. One of the two has a sum of two terms of the same sign, so that nothing cancels and not both
/// components vanish. True for the second one.
bool QuadraticRoot::from_constant() const {
  const int c1 = sign(q_[1]);
  return c1 == 0 ? sign(q_[2]) == 0 : slope_ * c1 > 0;
}

QuadraticRoot::QuadraticRoot(Quadratic q, int slope, Big discriminant)
    : q_(std::move(q)), slope_(slope), discriminant_(std::move(discriminant)) {
  // The single term errs by 2^-52; the sum by 2^-52 of a term, half of 2^-52 and 2^-53 of the root, and 2^-53: below
  // 2^-50.
  const bool second = from_constant();
  const ScaledCoefficient minus_c1 = scaled(-q_[1]);
  ScaledCoefficient root = square_root(scaled(discriminant_));
  root.mantissa *= second ? -slope_ : slope_;
  const ScaledCoefficient sum = plus_same_sign(minus_c1, root);
  ScaledCoefficient single = scaled(second ? q_[0] : q_[2]);
  single.exponent += 1;
  ScaledCoefficient u = second ? sum : single, v = second ? single : sum;
  const long top = u.mantissa == 0 ? v.exponent : v.mantissa == 0 ? u.exponent : std::max(u.exponent, v.exponent);
  approx_ = {times_power(u, 1 - top), times_power(v, 1 - top)};
  if (approx_[0] < 0) approx_ = {-approx_[0], -approx_[1]};
}

std::optional<QuadraticRoot> QuadraticRoot::of(const Quadratic& q, Slope slope) {
  if (q.is_zero()) return std::nullopt;
  Big d = q.discriminant();
  if (sign(d) < 0 || (sign(d) == 0) != (slope == Slope::touching)) return std::nullopt;
  return QuadraticRoot(q, sign_of(slope), std::move(d));
}

QuadraticRoot QuadraticRoot::rational(const Big& num, const Big& den) {
  if (sign(num) == 0 && sign(den) == 0) throw std::invalid_argument("QuadraticRoot::rational: 0 / 0");
  return {Quadratic(-num, den, Big()), sign(den), den * den};
}

bool QuadraticRoot::is_infinite() const { return sign(q_[2]) == 0 && (sign(q_[1]) == 0 || slope_ != sign(q_[1])); }

QuadraticRoot QuadraticRoot::reciprocal() const { return {q_.reversed(), -slope_, discriminant_}; }

int QuadraticRoot::exact_sign(const Quadratic& p) const {
  // At (a : -c1 + s r) with r = sqrt D, s = +-1 or 0.
  const bool second = from_constant();
  const Big a = shift_left<1>(second ? q_[0] : q_[2]), b = -q_[1];
  const Big &p0 = second ? p[2] : p[0], &p2 = second ? p[0] : p[2];
  const Big u = p0 * a * a + p[1] * a * b + p2 * (b * b + discriminant_);
  const Big v = p[1] * a + shift_left<1>(p2 * b);
  const int su = sign(u), sv = sign(v) * (second ? -slope_ : slope_);
  if (su * sv >= 0) return su != 0 ? su : sv;
  return su * sign(u * u - v * v * discriminant_);
}

SignAnswer sign_answer_at(const QuadraticRoot& root, const Quadratic& p) {
  const auto [u, v] = root.approx_;
  const double a = p.approx()[0] * u * u, b = p.approx()[1] * u * v, c = p.approx()[2] * v * v;
  if (const auto s = filtered(a + b + c, std::abs(a) + std::abs(b) + std::abs(c))) return {*s, Rung::doubles};
  return {root.exact_sign(p), Rung::big};
}

std::vector<QuadraticRoot> roots_of(const Quadratic& q) {
  std::vector<QuadraticRoot> roots;
  for (const Slope slope : {Slope::falling, Slope::touching, Slope::rising})
    if (auto root = QuadraticRoot::of(q, slope)) roots.push_back(std::move(*root));
  if (roots.size() == 2 && compare(roots[0], roots[1]) > 0) std::swap(roots[0], roots[1]);
  return roots;
}

SignAnswer compare_answer(const QuadraticRoot& a, const QuadraticRoot& b) {
  const auto [au, av] = a.approx();
  const auto [bu, bv] = b.approx();
  if (au > kUnderflowLoss && bu > kUnderflowLoss)
    if (const auto s = filtered(av * bu - bv * au, std::abs(av * bu) + std::abs(bv * au))) return {*s, Rung::doubles};
  const bool infinite = b.is_infinite();
  if (a.is_infinite()) return {infinite ? 0 : 1, Rung::big};
  return {infinite ? -1 : exact_compare(a, b), Rung::big};
}

SignAnswer compare_turns_answer(const QuadraticRoot& a, const QuadraticRoot& b) {
  bool exactly = false;
  const int x = turn_class(a, exactly), y = turn_class(b, exactly);
  if (x != y) return {x < y ? -1 : 1, exactly ? Rung::big : Rung::doubles};
  return compare_answer(a, b);
}

/// Of the difference of two quotients of components of 8 u each, times their sum: two components, the quotient, the
/// difference, and half of it and the sum that make the midpoint.
constexpr double kQuotients = rounding_bound(2 * 8 + 4, 128);

BigRational between(const QuadraticRoot& a, const QuadraticRoot& b) {
  const double low = a.approx()[1] / a.approx()[0], high = b.approx()[1] / b.approx()[0];
  const double midpoint = low + (high - low) / 2, gap = high - low,
               error = kQuotients * (std::abs(low) + std::abs(high));
  // The gap and its midpoint err by an eighth of the gap at most; a multiple of a quarter to a half of the gap lies
  // within a quarter of it from the midpoint. Nothing that is as large as kLeastGap has lost anything to underflow.
  constexpr double kKnownGap = 8, kLeastGap = 0x1p-900;
  if (std::isfinite(gap) && gap > kKnownGap * error && gap > kLeastGap) {
    const int k = 1 - std::ilogb(gap);
    if (std::abs(std::ldexp(midpoint, k)) < 0x1p52) {
      const BigInteger n(static_cast<std::int64_t>(std::nearbyint(std::ldexp(midpoint, k))));
      return k >= 0 ? BigRational(n, BigInteger(1) << static_cast<unsigned>(k))
                    : BigRational(BigInteger(n << static_cast<unsigned>(-k)));
    }
  }
  // Halving an interval that contains both.
  const auto against = [](const BigRational& x, const QuadraticRoot& r) {
    return compare(QuadraticRoot::rational(Big(numerator(x)), Big(denominator(x))), r);
  };
  BigRational from = -1, to = 1;
  while (against(from, a) > 0) from *= 2;
  while (against(to, b) < 0) to *= 2;
  for (;;) {
    const BigRational x = (from + to) / 2;
    if (against(x, a) <= 0) {
      from = x;
    } else if (against(x, b) >= 0) {
      to = x;
    } else {
      return x;
    }
  }
}

}  // namespace dymsum::exact
