// Closed intervals of doubles that contain the exact values of what is computed with them: the first look at a formula
// that is written as a template over its number type. RootExpression has the same vocabulary and answers where an
// interval does not.
//
// The rounding mode is left alone. A sum, product, quotient or root x in round to nearest lies between the neighbours
// of its double f, so any double beyond f's neighbour bounds it; results below the range of normal doubles as well.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>

#include "exact/big.h"
#include "exact/rounding_bound.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact
