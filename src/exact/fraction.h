// Quotients of integers of any size behind the operations that Int and Big have, for code that is written for these:
// coordinates whose denominators are their own. Never reduced: terms of one expression have one denominator for the
// most part, and signs are those of numerators.
#pragma once

#include <compare>
#include <cstdint>
#include <utility>

#include "exact/big.h"
#include "exact/int.h"

namespace dymsum::exact {

/// above / below, below > 0.
class Fraction {
 public:
  Fraction() = default;
  /// Requires below > 0.
  explicit Fraction(BigInteger above, BigInteger below = 1) : above_(std::move(above)), below_(std::move(below)) {}
  explicit Fraction(const BigRational& v) : Fraction(numerator(v), denominator(v)) {}
  template <int B>
  Fraction(const Int<B>& v) : above_(to_big(v).value()) {}  // NOLINT(google-explicit-constructor)
  Fraction(const Big& v) : above_(v.value()) {}             // NOLINT(google-explicit-constructor)
  static Fraction from_int64(std::int64_t v) { return Fraction(BigInteger(v)); }
  static Fraction from_dyadic_difference(std::int64_t m, int shift, std::int64_t n, int other_shift) {
    return Big::from_dyadic_difference(m, shift, n, other_shift);
  }

  const BigInteger& above() const { return above_; }
  const BigInteger& below() const { return below_; }

  friend Fraction operator+(const Fraction& a, const Fraction& b) {
    if (a.below_ == b.below_) return Fraction(a.above_ + b.above_, a.below_);
    return Fraction(a.above_ * b.below_ + b.above_ * a.below_, a.below_ * b.below_);
  }
  friend Fraction operator-(const Fraction& a, const Fraction& b) {
    if (a.below_ == b.below_) return Fraction(a.above_ - b.above_, a.below_);
    return Fraction(a.above_ * b.below_ - b.above_ * a.below_, a.below_ * b.below_);
  }
  friend Fraction operator*(const Fraction& a, const Fraction& b) {
    return Fraction(a.above_ * b.above_, a.below_ * b.below_);
  }
  friend Fraction operator-(const Fraction& a) { return Fraction(-a.above_, a.below_); }
  friend bool operator==(const Fraction& a, const Fraction& b) {
    return a.below_ == b.below_ ? a.above_ == b.above_ : a.above_ * b.below_ == b.above_ * a.below_;
  }

 private:
  BigInteger above_ = 0, below_ = 1;
};

inline int sign(const Fraction& v) { return v.above().sign(); }

/// v times a positive number that makes it a vector of integers without a common divisor.
inline Vector3<Fraction> integral(const Vector3<Fraction>& v) {
  BigInteger below = 1;
  for (const Fraction* c : {&v.x, &v.y, &v.z})
    if (c->below() != below) below = lcm(below, c->below());
  const auto whole = [&](const Fraction& c) { return BigInteger(c.above() * (below / c.below())); };
  BigInteger x = whole(v.x), y = whole(v.y), z = whole(v.z);
  const BigInteger common = gcd(gcd(x, y), z);
  if (common > 1) x /= common, y /= common, z /= common;
  return {Fraction(std::move(x)), Fraction(std::move(y)), Fraction(std::move(z))};
}

/// v 2^power rounded down.
inline BigInteger rounded_down(const Fraction& v, int power) {
  BigInteger above = v.above(), below = v.below(), quotient, rest;
  if (power >= 0) above <<= power;
  else below <<= -power;
  divide_qr(above, below, quotient, rest);
  if (rest.sign() < 0) quotient -= 1;
  return quotient;
}

/// The power of two by which a value has so many bits before the point, or one more or less.
inline int power_for_bits(const Fraction& v, int bits) {
  return bits - static_cast<int>(msb(abs(v.above()))) + static_cast<int>(msb(v.below()));
}

/// A double within 2^-51 of the value, exactly where it has at most 53 binary digits.
inline BinaryParts binary_parts(const Fraction& v) {
  if (sign(v) == 0) return {};
  const int power = power_for_bits(v, 120);
  BinaryParts parts = binary_parts(Big(rounded_down(v, power)));
  parts.exponent -= power;
  return parts;
}

/// The same for all fractions that are equal. Requires a denominator that is no multiple of the prime.
inline Residue residue(const Fraction& v) { return times(residue(Big(v.above())), inverse(residue(Big(v.below())))); }

}  // namespace dymsum::exact
