#include "exact/rational_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

#include "dymsum/rational.h"
#include "exact/big.h"

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

namespace {

bool is_integer(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Boost reads a leading 0 as octal.
BigInteger integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
  const BigInteger magnitude{std::string(text)};
  return negative ? BigInteger(-magnitude) : magnitude;
}

Result<BigRational> quotient(std::string_view num, std::string_view den, const std::string& name, ErrorCode code) {
  const std::string text = (std::string(num) + "/" + std::string(den)).substr(0, 60);
  if (!is_integer(num) || !is_integer(den))
    return Error{ErrorCode::malformed, "a " + name + " has to be a quotient of integers: " + text, {}};
  const BigInteger d = integer(den);
  if (d == 0) return Error{code, "a " + name + " with denominator zero: " + text, {}};
  return ratio(Big(integer(num)), Big(d));
}

/// digits[.digits][e[sign]digits] as a rational.
std::optional<BigRational> decimal(std::string_view text) {
  BigInteger mantissa = 0;
  long exponent = 0;
  bool negative = false, any = false, point = false;
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) negative = text[i++] == '-';
  for (; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
    } else if (std::isdigit(static_cast<unsigned char>(text[i]))) {
      mantissa = mantissa * 10 + (text[i] - '0');
      exponent -= point;
      any = true;
    } else {
      break;
    }
  }
  if (!any) return std::nullopt;
  if (i < text.size()) {
    if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
    const std::string digits(text.substr(i + 1 + (i + 1 < text.size() && text[i + 1] == '+')));
    if (!is_integer(digits) || digits.size() > 6) return std::nullopt;
    exponent += std::stol(digits);
  }
  if (std::abs(exponent) > 5000) return std::nullopt;
  const BigInteger power = boost::multiprecision::pow(BigInteger(10), static_cast<unsigned>(std::abs(exponent)));
  BigRational value = exponent >= 0 ? BigRational(BigInteger(mantissa * power)) : BigRational(mantissa, power);
  if (negative) value = -value;
  return value;
}

}  // namespace

Result<BigRational> number_in(std::string_view text, std::string_view what, ErrorCode code,
                              std::size_t most_characters) {
  const std::string name(what);
  if (text.size() > most_characters)
    return Error{code, "numerator and denominator of a " + name + " may have at most 4096 bits", {}};
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos)
    return quotient(text.substr(0, slash), text.substr(slash + 1), name, code);
  const std::optional<BigRational> value = decimal(text);
  if (!value) return Error{ErrorCode::malformed, "not a " + name + ": \"" + std::string(text.substr(0, 60)) + "\"", {}};
  return *value;
}

}  // namespace dymsum::exact

namespace dymsum {

using exact::BigInteger;
using exact::RationalAccess;
using exact::RationalParts;

namespace {

const RationalParts& parts(const Rational& r) { return RationalAccess::parts(r); }

/// The value of num / den, den > 0.
Rational reduced(BigInteger num, BigInteger den) {
  const BigInteger common = gcd(num, den);
  if (common != 1) {
    num /= common;
    den /= common;
  }
  return RationalAccess::make(std::move(num), std::move(den));
}

int compare(const Rational& a, const Rational& b) {
  const RationalParts &x = parts(a), &y = parts(b);
  return x.den == y.den ? x.num.compare(y.num) : BigInteger(x.num * y.den).compare(BigInteger(y.num * x.den));
}

}  // namespace

Rational::Rational(Whole value) {
  // Scales are 1 nearly everywhere: no memory is requested.
  static const Rational kOne = RationalAccess::make(BigInteger(1), BigInteger(1));
  *this = value.value == 1 ? kOne : RationalAccess::make(BigInteger(value.value), BigInteger(1));
}

Result<Rational> Rational::of(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) return Error{ErrorCode::malformed, "a quotient with denominator zero", {}};
  const int sign = denominator < 0 ? -1 : 1;
  return reduced(BigInteger(numerator) * sign, BigInteger(denominator) * sign);
}

Result<Rational> Rational::of(double value) {
  if (!(value - value == 0)) return Error{ErrorCode::not_finite, "a rational number has to be finite", {}};
  return exact::to_rational(exact::exact_value(value));
}

Result<Rational> Rational::parse(std::string_view text) {
  const Result<exact::BigRational> value = exact::number_in(text, "rational number", ErrorCode::malformed, text.size());
  if (!value) return value.error();
  return exact::to_rational(*value);
}

std::string Rational::numerator() const { return parts(*this).num.str(); }
std::string Rational::denominator() const { return parts(*this).den.str(); }
bool Rational::is_integer() const { return parts(*this).den == 1; }
int Rational::sign() const { return parts(*this).num.sign(); }
std::string Rational::to_string() const { return numerator() + "/" + denominator(); }

double Rational::to_double() const {
  const RationalParts& r = parts(*this);
  return exact::round_to_double(r.num, r.den);
}

Rational Rational::operator-() const {
  const RationalParts& r = parts(*this);
  return RationalAccess::make(BigInteger(-r.num), r.den);
}
Rational operator+(const Rational& a, const Rational& b) {
  const RationalParts &x = parts(a), &y = parts(b);
  return reduced(x.num * y.den + y.num * x.den, x.den * y.den);
}
Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
Rational operator*(const Rational& a, const Rational& b) {
  const RationalParts &x = parts(a), &y = parts(b);
  return reduced(x.num * y.num, x.den * y.den);
}
Rational operator/(const Rational& a, const Rational& b) {
  const RationalParts &x = parts(a), &y = parts(b);
  const int sign = y.num.sign();
  if (sign == 0) throw std::invalid_argument("Rational: division by zero");
  return reduced(x.num * y.den * sign, x.den * y.num * sign);
}

bool operator==(const Rational& a, const Rational& b) {
  return a.parts_ == b.parts_ || (parts(a).num == parts(b).num && parts(a).den == parts(b).den);
}
std::strong_ordering operator<=>(const Rational& a, const Rational& b) { return compare(a, b) <=> 0; }

}  // namespace dymsum
