#include <stdexcept>
#include <utility>

#include "dymsum/rational.h"
#include "exact/big.h"
#include "exact/rational_parts.h"
#include "exact/rational_text.h"

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
