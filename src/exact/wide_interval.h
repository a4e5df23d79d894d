// Intervals of some seventy digits, between exact::FineInterval and exact numbers, for magnitudes up to 2^62: in fixed
// point, so that a product costs 25 multiplications of words, whatever is multiplied.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "exact/big.h"
#include "exact/limbs.h"
#include "exact/rounding_bound.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact
