// Exact rational numbers as they leave and enter the library: ordinary values that compare, add and print exactly.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "dymsum/result.h"

namespace dymsum {

namespace exact {
struct RationalParts;
struct RationalAccess;
}  // namespace exact

/// A rational number of any size, never rounded. A value: copies share immutable parts, so copying is cheap, and equal
/// numbers are equal values. Sums, products and comparisons of numbers of b bits cost O(b^2) at most.
/// Thread-compatible.
class Rational {
 public:
  Rational() = default;  ///< 0
  template <std::signed_integral Integer>
  Rational(Integer value) : Rational(Whole{value}) {}

  /// numerator / denominator. Errors: malformed when the denominator is zero.
  static Result<Rational> of(std::int64_t numerator, std::int64_t denominator);
  /// The double at face value, m 2^e. Errors: not_finite for NaN and infinities.
  static Result<Rational> of(double value);
  /// "-3/2", "1.01" or "1e-3", each exactly what it says: 1.01 is 101/100. Exponents are at most 5000 in magnitude.
  /// Errors: malformed, with the text. O(n^2) for n characters.
  static Result<Rational> parse(std::string_view text);

  /// The numerator in lowest terms, as decimal digits; it has the sign, the denominator is positive. O(b^2).
  std::string numerator() const;
  std::string denominator() const;
  bool is_integer() const;
  /// -1, 0 or 1.
  int sign() const;

  /// "numerator/denominator", also when the denominator is 1: what parse reads back.
  std::string to_string() const;
  /// The nearest double (ties to even); infinite past the range of doubles. Zero is +0.
  double to_double() const;

  Rational operator-() const;
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  /// Requires: b is not zero (else std::invalid_argument).
  friend Rational operator/(const Rational& a, const Rational& b);
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }
  Rational& operator/=(const Rational& b) { return *this = *this / b; }

  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  friend struct exact::RationalAccess;
  struct Whole {
    std::int64_t value;
  };
  explicit Rational(Whole value);
  std::shared_ptr<const exact::RationalParts> parts_;  // null: 0
};

struct RationalPoint {
  Rational x, y;
  friend bool operator==(const RationalPoint&, const RationalPoint&) = default;
};

struct RationalPoint3 {
  Rational x, y, z;
  friend bool operator==(const RationalPoint3&, const RationalPoint3&) = default;
};

}  // namespace dymsum
