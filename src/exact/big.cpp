#include "exact/big.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "exact/rational_parts.h"

namespace dymsum::exact {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// num / den rounded half to even to an integer; num >= 0, den > 0.
BigInteger round_half_even(const BigInteger& num, const BigInteger& den) {
  BigInteger quotient, remainder;
  boost::multiprecision::divide_qr(num, den, quotient, remainder);
  remainder <<= 1;
  const int against_half = remainder.compare(den);
  if (against_half > 0 || (against_half == 0 && bit_test(quotient, 0))) ++quotient;
  return quotient;
}

/// The double nearest to num / den; num > 0, den > 0.
double round_positive(BigInteger num, BigInteger den) {
  // 2^(e - 1) < num / den < 2^(e + 1)
  const std::int64_t e = static_cast<std::int64_t>(msb(num)) - static_cast<std::int64_t>(msb(den));
  if (e > 1025) return kInfinity;
  if (e < -1076) return 0;  // below 2^-1075, half the smallest subnormal
  const bool below = e >= 0 ? num < (den << static_cast<unsigned>(e)) : (num << static_cast<unsigned>(-e)) < den;
  // floor(log2(num / den)) - 52 is the exponent of the last of 53 bits; subnormals keep fewer
  const int unit = std::max(static_cast<int>(e) - (below ? 1 : 0) - 52, -1074);
  if (unit < 0) num <<= static_cast<unsigned>(-unit);
  if (unit > 0) den <<= static_cast<unsigned>(unit);
  const auto mantissa = static_cast<std::uint64_t>(round_half_even(num, den));  // <= 2^53: exact as a double
  return std::ldexp(static_cast<double>(mantissa), unit);                       // exact, or infinite from 2^1024 on
}

}  // namespace

Big to_big(std::int64_t v) { return Big::from_int64(v); }

Big to_big(i128 v) {
  BigInteger r = static_cast<std::int64_t>(v >> 64);
  r <<= 64;
  r += static_cast<std::uint64_t>(v);
  return Big(std::move(r));
}

Big to_big(const std::uint64_t* limbs, int count) {
  BigInteger r = static_cast<std::int64_t>(limbs[count - 1]);
  for (int i = count - 2; i >= 0; --i) {
    r <<= 64;
    r += limbs[i];
  }
  return Big(std::move(r));
}

double to_double(const Big& a) {
  if (sign(a) == 0) return 0;
  const double magnitude = round_positive(abs(a.value()), 1);
  return sign(a) < 0 ? -magnitude : magnitude;
}

BigRational exact_value(double v) {
  if (!std::isfinite(v)) throw std::domain_error("exact_value: not a finite number");
  int e = 0;
  const auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &e), 53));
  e -= 53;
  if (e >= 0) return BigRational(BigInteger(BigInteger(m) << e));
  return BigRational(BigInteger(m), BigInteger(BigInteger(1) << -e));
}

BigRational exact_value(const Rational& v) {
  const RationalParts& r = RationalAccess::parts(v);
  return BigRational(r.num, r.den);
}
BigInteger numerator_of(const Rational& v) { return RationalAccess::parts(v).num; }
BigInteger denominator_of(const Rational& v) { return RationalAccess::parts(v).den; }

BigRational ratio(const Big& num, const Big& den) {
  if (sign(den) == 0) throw std::domain_error("ratio: zero denominator");
  // Boost 1.74's rational throws for a negative denominator of unbounded type
  return sign(den) > 0 ? BigRational(num.value(), den.value()) : BigRational((-num).value(), (-den).value());
}

Rational to_rational(const BigRational& v) { return RationalAccess::make(numerator(v), denominator(v)); }
Rational to_rational(BigInteger num, BigInteger den) { return RationalAccess::make(std::move(num), std::move(den)); }

double round_to_double(const BigRational& v) { return round_to_double(numerator(v), denominator(v)); }

double round_to_double(const BigInteger& num, const BigInteger& d) {
  if (num.is_zero()) return 0;
  const BigInteger n = abs(num);
  // Both are doubles: then their division is the one rounding.
  const double magnitude = msb(n) < 53 && msb(d) < 53 ? static_cast<double>(static_cast<std::uint64_t>(n)) /
                                                            static_cast<double>(static_cast<std::uint64_t>(d))
                                                      : round_positive(n, d);
  return num.sign() < 0 && magnitude != 0 ? -magnitude : magnitude;
}

}  // namespace dymsum::exact
