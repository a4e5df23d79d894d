// Intervals that hold a number: of doubles, of pairs of doubles, of doubles with a wide exponent, of integers with many
// digits.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/doubles.h"
#include "exact/big.h"
#include "exact/int.h"
#include "exact/rounding_bound.h"

namespace dymsum::exact {

// Closed intervals of doubles that contain the exact values of what is computed with them: the first look at a formula
// that is written as a template over its number type. RootExpression has the same vocabulary and answers where an
// interval does not.
//
// The rounding mode is left alone. A sum, product, quotient or root x in round to nearest lies between the neighbours
// of its double f, so any double beyond f's neighbour bounds it; results below the range of normal doubles as well.

/// All x with low() <= x <= high(), both finite, or the whole line: also for what overflows or is not defined.
class Interval {
 public:
  Interval() = default;  ///< [0, 0]
  /// Exactly v; the whole line for NaN and infinities.
  explicit Interval(double v) : Interval(v, v) {}
  template <std::integral Integer>
  explicit Interval(Integer v) : Interval(of_integer(v)) {}
  /// Some units in the last place wide, a point if v is a double.
  explicit Interval(const BigInteger& v) : Interval(of_integer(v)) {}
  explicit Interval(const Big& v) : Interval(of_integer(v.value())) {}
  template <int B>
  explicit Interval(const Int<B>& v) : Interval(Big(v)) {}
  explicit Interval(const BigRational& v) : Interval(Interval(numerator(v)) / Interval(denominator(v))) {}
  /// The whole line unless low <= high are finite.
  Interval(double low, double high) : low_(low), high_(high) {
    if (!(low > -kInfinity && low <= high && high < kInfinity)) low_ = -kInfinity, high_ = kInfinity;
  }
  static Interval whole() { return {-kInfinity, kInfinity}; }

  double low() const { return low_; }
  double high() const { return high_; }
  bool is_whole() const { return high_ == kInfinity; }
  bool is_point() const { return low_ == high_; }
  bool contains(double v) const { return low_ <= v && v <= high_; }
  bool contains_zero() const { return low_ <= 0 && high_ >= 0; }
  double midpoint() const { return low_ / 2 + high_ / 2; }

  friend Interval operator-(const Interval& a) { return {-a.high_, -a.low_}; }
  friend Interval operator+(const Interval& a, const Interval& b) {
    const double low = a.low_ + b.low_;
    if (a.is_point() && b.is_point()) return sum_is_exact(a.low_, b.low_, low) ? Interval(low) : around(low, low);
    return around(low, a.high_ + b.high_);
  }
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    if (a.is_whole() || b.is_whole()) return whole();
    const double p = a.low_ * b.low_;
    if (a.is_point() && b.is_point()) return product_is_exact(a.low_, b.low_, p) ? Interval(p) : around(p, p);
    if (a.low_ >= 0 && b.low_ >= 0) return around_positive(p, a.high_ * b.high_);
    const double q = a.low_ * b.high_, r = a.high_ * b.low_, s = a.high_ * b.high_;
    return around(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  /// The whole line where b contains 0.
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (a.is_whole() || b.is_whole() || b.contains_zero()) return whole();
    const double p = a.low_ / b.low_;
    if (a.is_point() && b.is_point()) return product_is_exact(p, b.low_, a.low_) ? Interval(p) : around(p, p);
    const double q = a.low_ / b.high_, r = a.high_ / b.low_, s = a.high_ / b.high_;
    return around(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  /// The roots of the numbers in a that are not negative; the whole line if there are none.
  friend Interval sqrt(const Interval& a) {
    if (a.is_whole() || a.high_ < 0) return whole();
    const double low = std::sqrt(std::max(a.low_, 0.0));
    if (a.is_point()) return product_is_exact(low, low, a.low_) ? Interval(low) : around_positive(low, low);
    return around_positive(low, std::sqrt(a.high_));
  }
  friend Interval square(const Interval& a) {
    if (a.is_point() || a.low_ >= 0 || a.high_ <= 0) return a * a;
    const double most = std::max(-a.low_, a.high_);
    return {0, above(most * most)};
  }
  friend Interval& operator+=(Interval& a, const Interval& b) { return a = a + b; }
  friend Interval& operator-=(Interval& a, const Interval& b) { return a = a - b; }
  friend Interval& operator*=(Interval& a, const Interval& b) { return a = a * b; }
  friend Interval& operator/=(Interval& a, const Interval& b) { return a = a / b; }

  /// -1, 0 or 1 if all its numbers have that sign; nothing where they do not.
  friend std::optional<int> sign_of(const Interval& a) {
    if (a.low_ > 0) return 1;
    if (a.high_ < 0) return -1;
    if (a.low_ == 0 && a.high_ == 0) return 0;
    return std::nullopt;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  // With w the distance from |f| to the next larger double, the share added is at least w for normal f (2^-52 |f| >= w)
  // and the least subnormal, which is w, for others. f + w is a double or the overflow threshold, so a sum of more
  // rounds to no less; towards zero the neighbour is no further than w.
  static double above(double f) { return f + (std::abs(f) * (2 * kRoundoff) + kLeast); }
  static double below(double f) { return f - (std::abs(f) * (2 * kRoundoff) + kLeast); }
  static constexpr double kLeast = std::numeric_limits<double>::denorm_min();

  static Interval around(double low, double high) { return {below(low), above(high)}; }
  /// The interval of numbers that are not negative.
  static Interval around_positive(double low, double high) { return {std::max(below(low), 0.0), above(high)}; }

  /// Knuth's error of a sum; NaN, where something overflows on the way, is no zero.
  static bool sum_is_exact(double a, double b, double sum) {
    const double b_part = sum - a, a_part = sum - b_part;
    return (a - a_part) + (b - b_part) == 0;
  }
  /// Dekker's error of a rounded product, exact where its parts are not below the least double, as they are not for
  /// products of at least 2^-900.
  static bool product_is_exact(double a, double b, double product) {
    if (a == 0 || b == 0) return product == 0;
    if (a * b != product || !(std::abs(product) >= 0x1p-900)) return false;
    const double ca = a * 134217729, cb = b * 134217729;
    const double a1 = ca - (ca - a), a2 = a - a1, b1 = cb - (cb - b), b2 = b - b1;
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2 == 0;
  }

  template <std::integral Integer>
  static Interval of_integer(Integer v) {
    const auto f = static_cast<double>(v);
    return std::abs(f) < 0x1p53 ? Interval(f) : around(f, f);
  }
  // Truncated to 64 bits, t <= |v| < t + 1: t is 2^63 at least, its double at most 2^10 off and the neighbours of that
  // 2^11 away above and, unless it is 2^63 itself, which is not above t, below.
  static Interval of_integer(const BigInteger& v) {
    if (v.is_zero()) return {};
    const BigInteger magnitude = boost::multiprecision::abs(v);
    const auto top = static_cast<unsigned>(msb(magnitude));
    const unsigned cut = top < 64 ? 0 : top - 63;
    if (cut > 1024) return whole();
    const auto leading = static_cast<double>(static_cast<std::uint64_t>(BigInteger(magnitude >> cut)));
    const bool exact = top - static_cast<unsigned>(lsb(magnitude)) < 53;
    const int e = static_cast<int>(cut);
    const Interval size = exact ? Interval(std::ldexp(leading, e))
                                : Interval(std::ldexp(below(leading), e), std::ldexp(above(leading), e));
    return v.sign() < 0 ? -size : size;
  }

  double low_ = 0, high_ = 0;
};

// Intervals of some thirty digits, between exact::Interval and exact numbers: with the same vocabulary, and about ten
// times as expensive as intervals of doubles.

/// All x with |x - midpoint()| <= radius, or the whole line: also for what is not defined, or is so large or small that
/// pairs of doubles could over- or underflow.
class FineInterval {
 public:
  FineInterval() = default;  ///< 0
  explicit FineInterval(double v) : FineInterval(base::DoublePair{v, 0}, 0) {}
  template <std::integral Integer>
  explicit FineInterval(Integer v) : FineInterval(static_cast<double>(v)) {
    static_assert(sizeof(Integer) <= 4);
  }
  explicit FineInterval(const Interval& v)
      : FineInterval(v.is_whole()   ? whole()
                     : v.is_point() ? FineInterval(v.low())
                                    : around(v)) {}
  static FineInterval whole() { return {base::DoublePair{}, std::numeric_limits<double>::infinity()}; }
  /// b - a exactly.
  static FineInterval difference(double a, double b) { return {base::exact_sum(b, -a), 0}; }

  bool is_whole() const { return !(radius_ < std::numeric_limits<double>::infinity()); }
  bool contains_zero() const { return !(std::abs(midpoint_.value()) > radius_); }
  /// Contains it.
  Interval rounded() const {
    if (is_whole()) return Interval::whole();
    const Interval midpoint = Interval(midpoint_.high) + Interval(midpoint_.low);
    return radius_ == 0 ? midpoint : midpoint + Interval(-radius_, radius_);
  }
  /// The double nearest to each of its numbers, where that is one and no tie.
  // midpoint_.high is nearest to the midpoint. Numbers closer to it than half the way to its nearer neighbour round to
  // it.
  std::optional<double> nearest() const {
    if (is_whole()) return std::nullopt;
    const double v = midpoint_.high, size = std::abs(v);
    if (v == 0) return radius_ == 0 && midpoint_.low == 0 ? std::optional<double>(0) : std::nullopt;
    const double gap = size - std::nextafter(size, 0.0);  // the one towards zero is the nearer one
    if (size > kSmall && (std::abs(midpoint_.low) + radius_) * kOutwards < gap / 2) return v;
    return std::nullopt;
  }

  friend FineInterval operator-(const FineInterval& a) { return {-a.midpoint_, a.radius_}; }
  friend FineInterval operator+(const FineInterval& a, const FineInterval& b) {
    const base::DoublePair s = a.midpoint_ + b.midpoint_;
    return {s, grown(a.radius_ + b.radius_, s)};
  }
  friend FineInterval operator-(const FineInterval& a, const FineInterval& b) { return a + -b; }
  friend FineInterval operator*(const FineInterval& a, const FineInterval& b) {
    if (a.is_zero() || b.is_zero()) return {};
    if (a.is_whole() || b.is_whole()) return whole();
    if (!a.is_moderate() || !b.is_moderate()) return a.folded() * b.folded();
    const base::DoublePair p = a.midpoint_ * b.midpoint_;
    return {p, grown(a.size() * b.radius_ + b.size() * a.radius_ + a.radius_ * b.radius_, p)};
  }
  /// The whole line where b contains 0.
  // With midpoints m, n and radii r, s: |x / y - m / n| <= (r + |m / n| s) / (|n| - s) for y of the sign of n.
  friend FineInterval operator/(const FineInterval& a, const FineInterval& b) {
    if (b.contains_zero() || !b.is_moderate()) return whole();
    if (a.is_zero()) return {};
    if (a.is_whole()) return whole();
    if (!a.is_moderate()) return a.folded() / b;
    const base::DoublePair q = a.midpoint_ / b.midpoint_;
    const double least = (b.size() * kInwards - b.radius_) * kInwards;
    if (!(least > 0)) return whole();
    return {q, grown((a.radius_ + std::abs(q.high) * kOutwards * b.radius_) / least, q)};
  }
  /// The roots of the numbers that are not negative; the whole line if there are none, or the midpoint is 0 or less.
  // |sqrt x - sqrt m| <= |x - m| / sqrt m.
  friend FineInterval sqrt(const FineInterval& a) {
    if (a.is_zero()) return {};
    if (a.is_whole() || !a.is_moderate() || !(a.midpoint_.high > 0)) return whole();
    const base::DoublePair root = base::square_root(a.midpoint_);
    return {root, grown(a.radius_ / (root.high * kInwards), root)};
  }

  /// -1, 0 or 1 if all its numbers have that sign; nothing where they do not.
  friend std::optional<int> sign_of(const FineInterval& a) {
    if (a.is_zero()) return 0;
    if (a.contains_zero()) return std::nullopt;
    return a.midpoint_.high > 0 ? 1 : -1;
  }

 private:
  FineInterval(base::DoublePair midpoint, double radius) : midpoint_(midpoint), radius_(radius) {
    // Also NaN.
    if (!(radius_ < std::numeric_limits<double>::infinity()) || !(std::abs(midpoint_.high) < kLarge))
      midpoint_ = {}, radius_ = std::numeric_limits<double>::infinity();
  }
  static FineInterval around(const Interval& v) {
    const double midpoint = v.midpoint();
    return {base::DoublePair{midpoint, 0}, std::max(v.high() - midpoint, midpoint - v.low()) * kOutwards + kUnderflow};
  }

  // Factors and divisors between these: no error term of a product, a quotient or a root underflows.
  static constexpr double kLarge = 0x1p300, kSmall = 0x1p-300;
  bool is_zero() const { return radius_ == 0 && midpoint_.high == 0 && midpoint_.low == 0; }
  double size() const { return std::abs(midpoint_.high) * kOutwards; }
  bool is_moderate() const { return midpoint_.high == 0 || std::abs(midpoint_.high) > kSmall; }
  /// The same interval with the midpoint 0 instead of one that is too small.
  FineInterval folded() const {
    return is_moderate() ? *this : FineInterval(base::DoublePair{}, (radius_ + size()) * kOutwards + kUnderflow);
  }

  /// A radius of few roundings, with the error of the midpoint.
  static double grown(double radius, base::DoublePair midpoint) {
    return (radius + std::abs(midpoint.high) * base::kPairError) * kOutwards + kUnderflow;
  }

  base::DoublePair midpoint_;
  double radius_ = 0;
};

// Intervals of some seventy digits, between exact::FineInterval and exact numbers, for magnitudes up to 2^62: in fixed
// point, so that a product costs 25 multiplications of words, whatever is multiplied.

/// All x with |x - m 2^-256| <= radius for an integer m, or the whole line: also for what is too large.
class WideInterval {
 public:
  static constexpr int kFractionBits = 256;
  /// What the last place of a midpoint stands for.
  static constexpr double kUnit = 0x1p-256;

  WideInterval() = default;  ///< 0
  template <std::integral Integer>
  explicit WideInterval(Integer v) {
    static_assert(sizeof(Integer) <= 4);
    midpoint_.w[4] = static_cast<std::uint64_t>(static_cast<std::int64_t>(v));
  }
  /// v, where it is a multiple of 2^-256; else what that is rounded to, and its error.
  static WideInterval of(double v);
  /// All within `error` of `value`, both times 2^shift.
  static WideInterval around(const BigInteger& value, const BigInteger& error, long shift);
  static WideInterval whole() {
    WideInterval all;
    all.radius_ = std::numeric_limits<double>::infinity();
    return all;
  }
  /// b - a.
  static WideInterval difference(double a, double b) { return of(b) - of(a); }

  bool is_whole() const { return !(radius_ < std::numeric_limits<double>::infinity()); }
  double radius() const { return radius_; }

  friend WideInterval operator-(const WideInterval& a) { return {limbs_sub(Midpoint{}, a.midpoint_), a.radius_}; }
  // Midpoints are below 2^318 in 320 bits: neither sums nor differences wrap around.
  friend WideInterval operator+(const WideInterval& a, const WideInterval& b) {
    return checked(limbs_add(a.midpoint_, b.midpoint_), (a.radius_ + b.radius_) * kOutwards);
  }
  friend WideInterval operator-(const WideInterval& a, const WideInterval& b) {
    return checked(limbs_sub(a.midpoint_, b.midpoint_), (a.radius_ + b.radius_) * kOutwards);
  }
  friend WideInterval operator*(const WideInterval& a, const WideInterval& b) {
    if (a.is_zero() || b.is_zero()) return {};
    if (a.is_whole() || b.is_whole()) return whole();
    const Midpoint u = magnitude(a.midpoint_), v = magnitude(b.midpoint_);
    const Limbs<10> all = limbs_multiply_unsigned<10>(u, v);
    if (all.w[9] != 0 || all.w[8] > kMost) return whole();
    Midpoint p;
    for (int k = 0; k < 5; ++k) p.w[k] = all.w[k + 4];
    if (a.midpoint_.negative() != b.midpoint_.negative()) p = limbs_sub(Midpoint{}, p);
    // |x y - m n| <= |m| s + |n| r + r s, and what is cut off is less than one unit.
    const bool cut = (all.w[0] | all.w[1] | all.w[2] | all.w[3]) != 0;
    const double r = a.radius_, s = b.radius_;
    double radius = cut ? kUnit : 0;
    if (r != 0 || s != 0) radius += at_most(u) * s + at_most(v) * r + r * s;
    return {p, radius * kOutwards};
  }

  /// -1, 0 or 1 if all its numbers have that sign; nothing where they do not.
  friend std::optional<int> sign_of(const WideInterval& a) {
    const int s = a.midpoint_ == Midpoint{} ? 0 : a.midpoint_.negative() ? -1 : 1;
    if (a.radius_ == 0) return s;
    if (a.is_whole() || !(at_least(magnitude(a.midpoint_)) > a.radius_)) return std::nullopt;
    return s;
  }

 private:
  using Midpoint = Limbs<5>;
  static constexpr std::uint64_t kMost = (std::uint64_t{1} << 62) - 1;
  // Radii are sums and products of a few numbers that are not negative. None underflows: no radius but 0 is below
  // 2^-256, no midpoint but 0 either.

  WideInterval(const Midpoint& midpoint, double radius) : midpoint_(midpoint), radius_(radius) {}
  static WideInterval checked(const Midpoint& midpoint, double radius) {
    const auto top = static_cast<std::int64_t>(midpoint.w[4]);
    const auto most = static_cast<std::int64_t>(kMost);
    return top > most || top < -most ? whole() : WideInterval(midpoint, radius);
  }
  bool is_zero() const { return radius_ == 0 && midpoint_ == Midpoint{}; }
  static Midpoint magnitude(const Midpoint& m) { return m.negative() ? limbs_sub(Midpoint{}, m) : m; }
  /// The value of a midpoint that is not negative.
  static double value(const Midpoint& m) {
    return static_cast<double>(m.w[4]) + static_cast<double>(m.w[3]) * 0x1p-64 +
           static_cast<double>(m.w[2]) * 0x1p-128 + static_cast<double>(m.w[1]) * 0x1p-192 +
           static_cast<double>(m.w[0]) * 0x1p-256;
  }
  static double at_most(const Midpoint& m) { return value(m) * kOutwards; }
  static double at_least(const Midpoint& m) { return value(m) * kInwards; }

  Midpoint midpoint_;
  double radius_ = 0;
};

// Real numbers known to some precision, however large: a binary number and how far off it may be. For exact decisions
// that need more bits than doubles have.

/// All x with |x - centre 2^exponent| <= radius 2^exponent. Results have about `precision` bits at most: what is cut
/// off, and what roots and quotients leave, goes into the radius. Exponents have room for any sum of sizes in memory.
class Ball {
 public:
  Ball() = default;  ///< exactly 0
  Ball(BigInteger centre, BigInteger radius, std::int64_t exponent, unsigned precision);

  /// a + b or, for the sign -1, a - b.
  static Ball sum(const Ball& a, const Ball& b, int sign_of_b, unsigned precision);
  static Ball product(const Ball& a, const Ball& b, unsigned precision);
  /// Nothing where b contains 0.
  static std::optional<Ball> quotient(const Ball& a, const Ball& b, unsigned precision);
  /// The roots of the numbers that are not negative. Requires that there are some.
  static Ball root(const Ball& a, unsigned precision);

  /// The sign of all its numbers, if they have one.
  std::optional<int> sign() const;
  /// All |x| < 2^top(); the least exponent for exactly 0.
  std::int64_t top() const;
  /// radius <= 2^-bits |centre|.
  bool is_narrow(unsigned bits) const;
  /// The smallest interval of doubles that contains it.
  Interval rounded_outwards() const;

 private:
  void move_to(std::int64_t exponent);

  BigInteger centre_ = 0, radius_ = 0;
  std::int64_t exponent_ = 0;
};

// Integers as pairs of doubles, with a relative error of at most 2^-104: exact up to 106 bits.

using base::DoublePair;

/// The error of an integer as a pair, times itself.
inline constexpr double kIntegerPairError = 0x1p-104;

/// Requires |v| <= 2^126. Either double errs by 2^-53 of what it rounds.
inline DoublePair integer_pair(i128 v) {
  const auto high = static_cast<double>(v);
  return {high, static_cast<double>(v - static_cast<i128>(high))};
}

/// A magnitude: of more than 126 bits the leading ones, the rest is below 2^-125.
template <int N>
DoublePair limbs_pair(const Limbs<N>& magnitude) {
  static_assert(N >= 2 && 64 * N <= 1023);
  int top = N - 1;
  while (top > 1 && magnitude.w[top] == 0) --top;
  u128 leading = static_cast<u128>(magnitude.w[top]) << 64 | magnitude.w[top - 1];
  if (top == 1 && leading >> 126 == 0) return integer_pair(static_cast<i128>(leading));
  const int zeros = std::countl_zero(magnitude.w[top]);
  if (zeros != 0) leading = leading << zeros | (top > 1 ? magnitude.w[top - 2] >> (64 - zeros) : 0);
  const DoublePair pair = integer_pair(static_cast<i128>(leading >> 2));
  const double scale = power_of_two(64 * (top - 1) - zeros + 2);
  return {pair.high * scale, pair.low * scale};
}

template <int B>
DoublePair integer_pair(const Int<B>& v) {
  if constexpr (B <= 126) {
    return integer_pair(static_cast<i128>(v.raw()));
  } else {
    return sign(v) < 0 ? -limbs_pair((-v).raw()) : limbs_pair(v.raw());
  }
}

/// Requires |v| < 2^1000.
inline DoublePair integer_pair(const Big& v) {
  if (sign(v) == 0) return {};
  const BigInteger magnitude = boost::multiprecision::abs(v.value());
  const int shift = std::max(0, static_cast<int>(msb(magnitude)) - 125);
  const DoublePair pair = integer_pair(narrowed<Int<126>>(Big(BigInteger(magnitude >> shift))));
  const double scale = sign(v) < 0 ? -power_of_two(shift) : power_of_two(shift);
  return {pair.high * scale, pair.low * scale};
}

}  // namespace dymsum::exact
