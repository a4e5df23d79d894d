#include "exact/decimal_text.h"

#include <cmath>
#include <cstdlib>

namespace dymsum::exact {
namespace {

BigInteger power_of_ten(long exponent) {
  return boost::multiprecision::pow(BigInteger(10), static_cast<unsigned>(exponent));
}

/// n / d 10^shift, rounded half to even.
BigInteger scaled(BigInteger n, BigInteger d, long shift) {
  (shift >= 0 ? n : d) *= power_of_ten(std::labs(shift));
  BigInteger quotient, remainder;
  divide_qr(n, d, quotient, remainder);
  const int against_half = BigInteger(remainder << 1).compare(d);
  if (against_half > 0 || (against_half == 0 && bit_test(quotient, 0))) ++quotient;
  return quotient;
}

}  // namespace

std::string decimal_text(const BigRational& v, int digits) {
  if (v.is_zero()) return "0";
  const BigInteger n = abs(numerator(v)), d = denominator(v);
  // 2^(b - 1) < n / d < 2^(b + 1): the exponent is right or one too small. Rounding up to a power of ten shows as a
  // digit too many as well.
  const double b = static_cast<double>(msb(n)) - static_cast<double>(msb(d));
  long exponent = std::lround(std::floor((b - 1) * 0.30102999566398119 - 1e-6));
  std::string text;
  for (;; ++exponent) {
    text = scaled(n, d, digits - 1 - exponent).str();
    if (static_cast<int>(text.size()) == digits) break;
  }
  if (digits > 1) text.insert(1, ".");
  const std::string power = std::to_string(std::labs(exponent));
  return (v < 0 ? "-" : "") + text + (exponent < 0 ? "e-" : "e+") + (power.size() < 2 ? "0" : "") + power;
}

}  // namespace dymsum::exact
