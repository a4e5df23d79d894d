// Integers and rationals of any size: their parts, roots and residues, and as text.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "exact/int.h"

namespace dymsum::exact {

// Arbitrary precision behind the same operations as Int<B>, so that templated code runs with either, and exact
// rationals with their one rounding to doubles. Includes Boost.Multiprecision: include int.h alone where that is
// enough.

using BigInteger = boost::multiprecision::cpp_int;
using BigRational = boost::multiprecision::cpp_rational;

/// An integer of any size. Int<B> converts implicitly, so products of a Big and a small constant Int need no care.
class Big {
 public:
  Big() = default;
  explicit Big(BigInteger value) : value_(std::move(value)) {}
  template <int B>
  Big(const Int<B>& v);  // NOLINT(google-explicit-constructor)

  static Big from_int64(std::int64_t v) { return Big(BigInteger(v)); }
  /// m * 2^shift - n * 2^other_shift, shifts >= 0.
  static Big from_dyadic_difference(std::int64_t m, int shift, std::int64_t n, int other_shift) {
    return Big(BigInteger((BigInteger(m) << shift) - (BigInteger(n) << other_shift)));
  }

  const BigInteger& value() const { return value_; }

  friend Big operator+(const Big& a, const Big& b) { return Big(BigInteger(a.value_ + b.value_)); }
  friend Big operator-(const Big& a, const Big& b) { return Big(BigInteger(a.value_ - b.value_)); }
  friend Big operator*(const Big& a, const Big& b) { return Big(BigInteger(a.value_ * b.value_)); }
  friend Big operator-(const Big& a) { return Big(BigInteger(-a.value_)); }
  friend bool operator==(const Big& a, const Big& b) { return a.value_ == b.value_; }
  friend std::strong_ordering operator<=>(const Big& a, const Big& b) { return a.value_.compare(b.value_) <=> 0; }

 private:
  BigInteger value_;
};

/// The same integer.
inline const Big& to_big(const Big& v) { return v; }
Big to_big(std::int64_t v);
Big to_big(i128 v);
/// The integer that has these limbs, in two's complement, least significant first.
Big to_big(const std::uint64_t* limbs, int count);

template <int N>
Big to_big(const Limbs<N>& v) {
  return to_big(v.w.data(), N);
}
template <int B>
Big to_big(const Int<B>& v) {
  return to_big(v.raw());
}
template <int B>
Big::Big(const Int<B>& v) : Big(to_big(v)) {}

inline int sign(const Big& a) { return a.value().sign(); }
inline Big abs(const Big& a) { return sign(a) < 0 ? -a : a; }
/// The same integer as a C. Requires |v| <= 2^B for C = Int<B>, asserted in debug builds.
template <class C>
C narrowed(const Big& v) {
  if constexpr (std::is_same_v<C, Big>) {
    return v;
  } else {
    const BigInteger magnitude = boost::multiprecision::abs(v.value());
    if constexpr (C::kBits > 126) {
      typename C::Raw raw;
      BigInteger rest = magnitude;
      for (std::uint64_t& limb : raw.w) {
        limb = static_cast<std::uint64_t>(rest & ~std::uint64_t{0});
        rest >>= 64;
      }
      return C::from_raw(v.value().sign() < 0 ? limbs_sub(typename C::Raw{}, raw) : raw);
    } else {
      const BigInteger word = (BigInteger(1) << 64) - 1;
      const u128 low = static_cast<std::uint64_t>(magnitude & word),
                 high = static_cast<std::uint64_t>((magnitude >> 64) & word);
      const i128 raw = static_cast<i128>((high << 64) | low);
      return C::from_raw(raw_cast<C::kBits>(v.value().sign() < 0 ? -raw : raw));
    }
  }
}

/// The nearest double (ties to even): relative error at most 2^-53, exact when it has at most 53 significant bits;
/// infinite past the double range.
double to_double(const Big& a);
template <int K>
Big shift_left(const Big& a) {
  static_assert(K >= 0);
  return Big(BigInteger(a.value() << K));
}

/// The number a finite double stands for, m 2^e. Throws std::domain_error for NaN and infinities.
BigRational exact_value(double v);
/// The number behind a public value.
BigRational exact_value(const Rational& v);
BigInteger numerator_of(const Rational& v);
BigInteger denominator_of(const Rational& v);  ///< positive
/// num/den, den of either sign (BigRational's own constructor wants a positive one). Throws std::domain_error when den
/// is zero.
BigRational ratio(const Big& num, const Big& den);

/// The public value of a rational.
Rational to_rational(const BigRational& v);
/// The same of num / den. Requires: lowest terms, den > 0; no common divisor is looked for.
Rational to_rational(BigInteger num, BigInteger den);

/// The double nearest to v, ties to even, subnormals included; values of at least 2^1024 - 2^970 in magnitude give
/// infinity, as in IEEE 754. Zero is always +0, also for negative v that round to zero.
double round_to_double(const BigRational& v);
/// The same of num / den. Requires: den > 0.
double round_to_double(const BigInteger& num, const BigInteger& den);

// What a Rational holds, for code that computes with it.

/// Lowest terms, den > 0.
struct RationalParts {
  BigInteger num = 0, den = 1;
};

struct RationalAccess {
  static const RationalParts& parts(const Rational& r) {
    static const RationalParts zero;
    return r.parts_ ? *r.parts_ : zero;
  }
  /// Requires: lowest terms, den > 0.
  static Rational make(BigInteger num, BigInteger den) {
    Rational r;
    r.parts_ = std::make_shared<const RationalParts>(RationalParts{std::move(num), std::move(den)});
    return r;
  }
};

// Exact integers of any size as a double and a power of two: where the integer itself lies beyond the range of doubles.

/// mantissa 2^exponent, 1/2 <= |mantissa| < 1; the mantissa of zero is 0.
struct BinaryParts {
  double mantissa = 0;
  int exponent = 0;

  /// The value times 2^shift, where that is a double that is not subnormal.
  double scaled(int shift) const { return std::ldexp(mantissa, exponent + shift); }
  bool is_zero() const { return mantissa == 0; }
};

inline BinaryParts binary_parts(double v, int shift = 0) {
  int exponent = 0;
  const double mantissa = std::frexp(v, &exponent);
  return {mantissa, exponent + shift};
}

/// A double within 2^-51 of the value, exactly where that has at most 53 binary digits. What is cut off first is below
/// 2^-100 of the value: no less than two whole limbs are left, and rounding them as to_double does errs by 2^-52.
template <int B>
BinaryParts binary_parts(const Int<B>& v) {
  if constexpr (B <= 960) {
    return binary_parts(to_double(v));
  } else {
    const auto magnitude = abs(v).raw();
    constexpr int kLimbs = limb_count(B);
    int top = kLimbs - 1;
    while (top > 0 && magnitude.w[static_cast<std::size_t>(top)] == 0) --top;
    const int first = top < 4 ? 0 : top - 3;
    Limbs<5> leading;  // four limbs, and a sign
    for (int i = first; i <= top; ++i)
      leading.w[static_cast<std::size_t>(i - first)] = magnitude.w[static_cast<std::size_t>(i)];
    const double size = limbs_to_double(leading);
    return binary_parts(sign(v) < 0 ? -size : size, 64 * first);
  }
}
inline BinaryParts binary_parts(const Big& v) {
  const BigInteger size = boost::multiprecision::abs(v.value());
  if (size == 0) return {};
  const auto bits = static_cast<int>(msb(size));
  const int cut = bits < 960 ? 0 : bits - 200;
  const double leading = to_double(Big(BigInteger(size >> static_cast<unsigned>(cut))));
  return binary_parts(sign(v) < 0 ? -leading : leading, cut);
}

// The order of rationals by one product each. Boost's own compares their continued fractions, which for equal or nearly
// equal ones go on to the end.

/// The sign of a - b.
inline int compare(const BigRational& a, const BigRational& b) {
  const BigInteger &n = numerator(a), &m = numerator(b), &d = denominator(a), &e = denominator(b);
  return d == e ? n.compare(m) : BigInteger(n * e).compare(BigInteger(m * d));
}

// Square roots of exact numbers, rounded once.

/// The double nearest to the square root of v, ties to even, also where v itself is no double: as small or as large as
/// it likes. Infinite past the range of doubles. Requires v >= 0.
double root_to_double(const BigRational& v);

/// The largest r with r^2 <= n, and rest = n - r^2. Requires n >= 0. A few divisions of n's length.
BigInteger floor_root(const BigInteger& n, BigInteger& rest);

// Fractions whose denominators are products of known factors: lowest terms without the greatest common divisor of two
// long integers.

/// The product, by halves. 1 of none.
BigInteger product_of(std::span<const BigInteger> factors);

/// gcd(value, product of the factors), for a value that is not 0. Cost: O(M(b) log n) for n factors of b bits together,
/// and a gcd of b bits only where all factors have a part in common with the value.
BigInteger gcd_with_product(std::span<const BigInteger> factors, const BigInteger& value);

// A position of the plane as a fraction.

/// (x / w, y / w), w > 0, not necessarily in lowest terms.
struct HomogeneousPoint {
  BigInteger x, y, w;
};

/// The same position without a common factor; without common factors of two.
HomogeneousPoint in_lowest_terms(HomogeneousPoint p);
HomogeneousPoint without_twos(HomogeneousPoint p);
/// That of a finite double point.
HomogeneousPoint homogeneous(double x, double y);

// Exact numbers as text and of text: fractions, decimals.

// Exact rationals as decimal numbers of a given length.

/// v with `digits` significant digits, rounded half to even, and an exponent of two digits or more, as "%.16e" prints
/// doubles: "-1.25e+400"; "0" for zero. Requires digits >= 1.
std::string decimal_text(const BigRational& v, int digits);

// Rational numbers as people write them.

inline constexpr unsigned kMaxTextBits = 4096;  ///< of numerators and denominators

/// "3/2", "1.01" or "1e-3", each exactly what it says; `what` names it in messages. Errors: malformed for anything
/// else; `code` for a denominator of zero and for texts much too long.
Result<BigRational> number_in(std::string_view text, std::string_view what, ErrorCode code,
                              std::size_t most_characters = 4 * kMaxTextBits);

// Exact integers modulo the prime 2^61 - 1: a value that every representation of a rational number shares, to find
// equal ones by.

/// A number below 2^61 - 1.
using Residue = std::uint64_t;
inline constexpr Residue kResiduePrime = (std::uint64_t{1} << 61) - 1;

/// v modulo the prime, for any 128 bits: v = a 2^61 + b, and 2^61 is 1.
constexpr Residue folded(u128 v) {
  std::uint64_t low = static_cast<std::uint64_t>(v) & kResiduePrime;
  low += static_cast<std::uint64_t>(v >> 61) & kResiduePrime;  // below 2^62
  low += static_cast<std::uint64_t>(v >> 122);                 // at most 2^6
  low = (low & kResiduePrime) + (low >> 61);
  return low >= kResiduePrime ? low - kResiduePrime : low;
}
constexpr Residue times(Residue a, Residue b) { return folded(static_cast<u128>(a) * b); }
constexpr Residue plus(Residue a, Residue b) {
  const Residue s = a + b;
  return s >= kResiduePrime ? s - kResiduePrime : s;
}
constexpr Residue minus(Residue a, Residue b) { return a >= b ? a - b : a + kResiduePrime - b; }

/// The factor with times(a, inverse(a)) == 1, by Fermat. Requires a != 0.
constexpr Residue inverse(Residue a) {
  Residue result = 1;
  for (std::uint64_t e = kResiduePrime - 2; e != 0; e >>= 1, a = times(a, a))
    if (e & 1) result = times(result, a);
  return result;
}

/// The residue of an exact integer.
template <int B>
Residue residue(const Int<B>& v) {
  if constexpr (B <= 62) {
    return v.raw() < 0 ? minus(0, folded(static_cast<u128>(-static_cast<i128>(v.raw()))))
                       : folded(static_cast<u128>(v.raw()));
  } else if constexpr (B <= 126) {
    return v.raw() < 0 ? minus(0, folded(static_cast<u128>(-v.raw()))) : folded(static_cast<u128>(v.raw()));
  } else {
    const Int<B> size = abs(v);
    Residue r = 0;
    for (int i = static_cast<int>(size.raw().w.size()); i-- > 0;)
      r = folded((static_cast<u128>(r) << 64) + size.raw().w[i]);
    return sign(v) < 0 ? minus(0, r) : r;
  }
}
inline Residue residue(const Big& v) {
  const auto r = static_cast<Residue>(boost::multiprecision::abs(v.value()) % kResiduePrime);
  return sign(v) < 0 ? minus(0, r) : r;
}

static_assert(times(inverse(12345), 12345) == 1 && plus(minus(3, 5), 2) == 0);

}  // namespace dymsum::exact
