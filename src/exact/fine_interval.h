// Intervals of some thirty digits, between exact::Interval and exact numbers: with the same vocabulary, and about ten
// times as expensive as intervals of doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "base/double_pair.h"
#include "exact/interval.h"
#include "exact/rounding_bound.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact
