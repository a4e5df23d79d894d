#include "exact/big.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "dymsum/rational.h"
#include "exact/grid.h"

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

// With num / den scaled by 4^k to at least 2^128, its root has at least 64 bits: r, its whole part, and one more bit
// that says whether something follows. Doubles and the midpoints between two of them have at most 54 bits, so the
// number made of r and that bit lies on the same side of each of them as the root does, or is the same.
double root_to_double(const BigRational& v) {
  if (v < 0) throw std::logic_error("root_to_double: of a negative number");
  if (v.is_zero()) return 0;
  BigInteger num = numerator(v), den = denominator(v);
  const int size = static_cast<int>(msb(num)) - static_cast<int>(msb(den));  // num / den > 2^(size - 1)
  const int k = size >= 130 ? 0 : (130 - size) / 2;
  num <<= static_cast<unsigned>(2 * k);
  BigInteger whole, rest, left;
  divide_qr(num, den, whole, rest);
  const BigInteger r = floor_root(whole, left);
  const BigInteger r_and_more = 2 * r + (left != 0 || rest != 0 ? 1 : 0);
  return round_to_double(BigRational(r_and_more, BigInteger(1) << static_cast<unsigned>(k + 1)));
}

// Newton's iteration from above falls until it reaches the root rounded down.
BigInteger floor_root(const BigInteger& n, BigInteger& rest) {
  rest = 0;
  if (n.is_zero()) return 0;
  // At most 62 leading bits, an even number of them cut off: their root in doubles, rounded up.
  const unsigned length = static_cast<unsigned>(msb(n)) + 1, cut = length <= 62 ? 0 : (length - 61) / 2 * 2;
  const double leading = std::sqrt(static_cast<double>(static_cast<std::uint64_t>(n >> cut)) + 1);
  BigInteger root = (BigInteger(static_cast<std::uint64_t>(leading)) + 2) << (cut / 2);
  for (;;) {
    BigInteger next = (root + n / root) >> 1;
    if (next >= root) break;
    root = std::move(next);
  }
  rest = n - root * root;
  return root;
}

BigInteger product_of(std::span<const BigInteger> factors) {
  if (factors.empty()) return 1;
  if (factors.size() == 1) return factors[0];
  return product_of(factors.first(factors.size() / 2)) * product_of(factors.subspan(factors.size() / 2));
}

namespace {

/// The product over factors f of gcd(f, value): the value's remainder is taken by ever smaller products of factors.
BigInteger product_of_gcds(std::span<const BigInteger> factors, const BigInteger& value) {
  if (factors.size() == 1) return gcd(factors[0], BigInteger(value % factors[0]));
  const auto left = factors.first(factors.size() / 2), right = factors.subspan(factors.size() / 2);
  return product_of_gcds(left, BigInteger(value % product_of(left))) *
         product_of_gcds(right, BigInteger(value % product_of(right)));
}

}  // namespace

// With D the product of the factors f, gcd(N, D) = gcd(N, product of gcd(f, N)): for every prime, the smaller of its
// powers in N and D is the smaller of that in N and the sum over f of the smaller of those in N and f.
BigInteger gcd_with_product(std::span<const BigInteger> factors, const BigInteger& value) {
  if (factors.empty()) return 1;
  const BigInteger magnitude = abs(value);
  const BigInteger part = product_of_gcds(factors, BigInteger(magnitude % product_of(factors)));
  return gcd(part, BigInteger(magnitude % part));
}

HomogeneousPoint without_twos(HomogeneousPoint p) {
  unsigned twos = static_cast<unsigned>(lsb(p.w));
  for (const BigInteger* v : {&p.x, &p.y})
    if (twos > 0 && !v->is_zero()) twos = std::min(twos, static_cast<unsigned>(lsb(BigInteger(abs(*v)))));
  if (twos > 0)
    for (BigInteger* v : {&p.x, &p.y, &p.w}) *v >>= twos;
  return p;
}

HomogeneousPoint in_lowest_terms(HomogeneousPoint p) {
  p = without_twos(std::move(p));
  // Most denominators are powers of two, which need no greatest common divisor.
  if (msb(p.w) == lsb(p.w)) {
    if (p.x.is_zero() && p.y.is_zero()) p.w = 1;
    return p;
  }
  const BigInteger common = gcd(gcd(p.x, p.w), p.y);
  if (common != 1)
    for (BigInteger* v : {&p.x, &p.y, &p.w}) *v /= common;
  return p;
}

HomogeneousPoint homogeneous(double x, double y) {
  const Dyadic a = to_dyadic(x), b = to_dyadic(y);
  const int low = std::min({a.mantissa == 0 ? 0 : a.exponent, b.mantissa == 0 ? 0 : b.exponent, 0});
  const auto numerator = [&](const Dyadic& d) {
    return d.mantissa == 0 ? BigInteger(0) : BigInteger(BigInteger(d.mantissa) << (d.exponent - low));
  };
  return {numerator(a), numerator(b), BigInteger(1) << -low};
}

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
