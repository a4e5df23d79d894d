#include "exact/polynomial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace dymsum::exact {
namespace {

using Terms = std::vector<BigInteger>;

/// mantissa 2^exponent, 1/2 <= |mantissa| <= 1 or zero.
struct Scaled {
  double mantissa = 0;
  long exponent = 0;
};

/// Relative error below 2^-51. Limbs of 64 bits: the two leading ones are rounded, by 2^-53 and, as the value is at
/// least 2^64 units of the second, 2^-54; their sum by 2^-53; what is cut is below one such unit. Limbs of 32 bits: the
/// three leading ones are exact, two sums are rounded.
Scaled scaled(const BigInteger& v) {
  constexpr unsigned kLimbBits = sizeof(boost::multiprecision::limb_type) * 8;
  constexpr unsigned kLeading = 64 / kLimbBits + 1;
  if (v.is_zero()) return {};
  const auto* limbs = v.backend().limbs();
  const unsigned size = v.backend().size(), cut = size > kLeading ? size - kLeading : 0;
  double sum = 0;
  for (unsigned i = size; i-- > cut;) sum = sum * (kLimbBits == 64 ? 0x1p64 : 0x1p32) + static_cast<double>(limbs[i]);
  int exponent = 0;
  const double mantissa = std::frexp(v.sign() < 0 ? -sum : sum, &exponent);
  return {mantissa, exponent + static_cast<long>(cut * kLimbBits)};
}

void trim(Terms& terms) {
  while (!terms.empty() && terms.back().is_zero()) terms.pop_back();
}

Terms terms_of(const Polynomial& p) {
  Terms terms;
  for (int k = 0; k <= p.degree(); ++k) terms.push_back(p[k].value());
  return terms;
}

Polynomial polynomial(Terms terms) {
  std::vector<Big> c;
  c.reserve(terms.size());
  for (BigInteger& term : terms) c.emplace_back(std::move(term));
  return Polynomial(std::move(c));
}

void make_primitive(Terms& terms) {
  BigInteger content = 0;
  for (const BigInteger& term : terms) {
    content = boost::multiprecision::gcd(content, term);
    if (content == 1) return;
  }
  for (BigInteger& term : terms) term /= content;
}

/// a becomes |lead b|^m a less a multiple of b, of a degree below b's; returns m.
std::size_t reduce(Terms& a, const Terms& b) {
  const BigInteger leading = boost::multiprecision::abs(b.back());
  std::size_t steps = 0;
  for (; a.size() >= b.size(); ++steps) {
    const BigInteger factor = b.back().sign() > 0 ? a.back() : BigInteger(-a.back());
    const std::size_t offset = a.size() - b.size();
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] *= leading;
      if (k >= offset) a[k] -= factor * b[k - offset];
    }
    trim(a);
  }
  return steps;
}

BigInteger power(const BigInteger& base, std::size_t exponent) {
  return boost::multiprecision::pow(base, static_cast<unsigned>(exponent));
}

/// The next subresultant, up to its sign: |lead b|^(deg a - deg b + 1) a modulo b, divided by scale, exactly.
Terms next_subresultant(Terms a, const Terms& b, const BigInteger& scale) {
  const std::size_t most = a.size() - b.size() + 1, steps = reduce(a, b);
  const BigInteger missing = power(b.back(), most - steps);
  for (BigInteger& term : a) {
    if (steps < most) term *= missing;
    term /= scale;
  }
  return a;
}

/// The primitive polynomial that is a multiple of a, if its leading coefficient is positive and divides bound: times
/// bound over its leading coefficient, a has small coefficients, whose common divisor is soon computed.
Terms primitive_below(Terms a, const BigInteger& bound) {
  const BigInteger leading = a.back();
  for (BigInteger& term : a) term = BigInteger(term * bound) / leading;
  make_primitive(a);
  return a;
}

/// The greatest common divisor, primitive, its leading coefficient positive: Algorithm C of Knuth, TAOCP 2, 4.6.1. What
/// divides both leading coefficients bounds that of the divisor.
Terms common_divisor(Terms a, Terms b) {
  if (a.size() < b.size()) std::swap(a, b);
  if (a.empty()) return {};
  const BigInteger leading = b.empty() ? a.back() : b.back();
  const BigInteger bound = boost::multiprecision::gcd(a.back(), leading);
  BigInteger g = 1, h = 1;
  while (!b.empty()) {
    if (b.size() == 1) return {1};
    const std::size_t drop = a.size() - b.size();
    Terms next = next_subresultant(std::move(a), b, g * power(h, drop));
    a = std::exchange(b, std::move(next));
    g = a.back();
    if (drop > 0) h = power(g, drop) / power(h, drop - 1);
  }
  return primitive_below(std::move(a), bound);
}

/// a / b. Requires that b is primitive and divides a; the quotient is then integral (Gauss).
Terms quotient(Terms a, const Terms& b) {
  Terms q(a.size() < b.size() ? 0 : a.size() - b.size() + 1);
  for (std::size_t i = q.size(); i-- > 0;) {
    q[i] = a[i + b.size() - 1] / b.back();
    for (std::size_t k = 0; k < b.size(); ++k) a[i + k] -= q[i] * b[k];
  }
  return q;
}

Terms derivative_of(const Terms& a) {
  Terms d;
  for (std::size_t k = 1; k < a.size(); ++k) d.push_back(a[k] * static_cast<unsigned>(k));
  return d;
}

Terms difference(Terms a, const Terms& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) a[k] -= b[k];
  trim(a);
  return a;
}

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  const u128 product = static_cast<u128>(a) * b;
  const std::uint64_t sum = static_cast<std::uint64_t>(product & kPrime) + static_cast<std::uint64_t>(product >> 61);
  return sum >= kPrime ? sum - kPrime : sum;
}

std::uint64_t residue(const Big& v, std::uint64_t prime) {
  const auto r = static_cast<std::uint64_t>(boost::multiprecision::abs(v.value()) % prime);
  return r != 0 && sign(v) < 0 ? prime - r : r;
}

/// Coefficients modulo kPrime.
struct Residues {
  std::array<std::uint64_t, Polynomial::kMaxDegree + 1> c{};
  int degree = -1;

  explicit Residues(const Polynomial& p) : degree(p.degree()) {
    for (int k = 0; k <= degree; ++k) (*this)[k] = residue(p[k], kPrime);
    trim();
  }
  std::uint64_t& operator[](int k) { return c[static_cast<std::size_t>(k)]; }
  void trim() {
    while (degree >= 0 && (*this)[degree] == 0) --degree;
  }
};

/// a becomes a multiple of itself, by a unit, less a multiple of b.
void reduce(Residues& a, Residues& b) {
  while (a.degree >= b.degree) {
    const std::uint64_t leading = b[b.degree], factor = a[a.degree];
    const int offset = a.degree - b.degree;
    for (int k = 0; k <= a.degree; ++k) {
      a[k] = times(a[k], leading);
      if (k >= offset) a[k] += kPrime - times(factor, b[k - offset]);
      if (a[k] >= kPrime) a[k] -= kPrime;
    }
    a.trim();
  }
}

/// f has a root modulo the prime, or its leading coefficient is 0 there.
bool may_have_root(const Polynomial& f, std::uint64_t prime) {
  std::array<std::uint64_t, Polynomial::kMaxDegree + 1> c;
  const auto n = static_cast<std::size_t>(f.degree());
  for (std::size_t k = 0; k <= n; ++k) c[k] = residue(f[static_cast<int>(k)], prime);
  if (c[n] == 0) return true;
  for (std::uint64_t t = 0; t < prime; ++t) {
    std::uint64_t value = 0;
    for (std::size_t k = n + 1; k-- > 0;) value = (value * t + c[k]) % prime;
    if (value == 0) return true;
  }
  return false;
}

}  // namespace

Polynomial::Polynomial() {
  static const std::shared_ptr<const Data> kZero = std::make_shared<const Data>();
  data_ = kZero;
}

Polynomial::Polynomial(std::vector<Big> coefficients) {
  while (!coefficients.empty() && exact::sign(coefficients.back()) == 0) coefficients.pop_back();
  if (coefficients.size() > kMaxDegree + 1) throw std::invalid_argument("Polynomial: degree above 6");
  const auto data = std::make_shared<Data>();
  data->degree = static_cast<int>(coefficients.size()) - 1;
  std::array<Scaled, kMaxDegree + 1> doubles;
  long top = 0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    doubles[k] = scaled(coefficients[k].value());
    top = std::max(top, doubles[k].exponent);
    data->c[k] = std::move(coefficients[k]);
  }
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    const long e = doubles[k].exponent + 1 - top;
    data->approx[k] = e < -1100 ? 0 : std::ldexp(doubles[k].mantissa, static_cast<int>(e));
  }
  data_ = data;
}

Polynomial Polynomial::derivative() const { return polynomial(derivative_of(terms_of(*this))); }

int Polynomial::sign_at(const Big& num, const Big& den) const {
  BigInteger value = 0, power = 1;
  for (int k = degree(); k >= 0; --k) {
    value = value * num.value() + (*this)[k].value() * power;
    power *= den.value();
  }
  return value.sign();
}

int Polynomial::sign_at(const BigRational& x) const { return sign_at(Big(numerator(x)), Big(denominator(x))); }

BigInteger Polynomial::value_at_dyadic(const BigInteger& x, unsigned shift) const {
  BigInteger value = 0;
  for (int k = degree(); k >= 0; --k) {
    value *= x;
    value += BigInteger((*this)[k].value() << shift * static_cast<unsigned>(degree() - k));
  }
  return value;
}

Polynomial primitive_part(const Polynomial& p) {
  Terms terms = terms_of(p);
  make_primitive(terms);
  return polynomial(std::move(terms));
}

Polynomial pseudo_remainder(const Polynomial& a, const Polynomial& b) {
  Terms remainder = terms_of(a);
  reduce(remainder, terms_of(b));
  make_primitive(remainder);
  return polynomial(std::move(remainder));
}

Polynomial gcd(const Polynomial& a, const Polynomial& b) {
  return polynomial(common_divisor(terms_of(a), terms_of(b)));
}

bool proved_coprime(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return false;
  Residues x(a), y(b);
  if (x.degree != a.degree()) return false;
  while (y.degree > 0) {
    reduce(x, y);
    std::swap(x, y);
  }
  return y.degree == 0;
}

bool proved_without_rational_roots(const Polynomial& f) {
  if (f.is_zero()) return false;
  for (const unsigned prime : {17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61})
    if (!may_have_root(f, prime)) return true;
  return false;
}

std::vector<Polynomial> square_free_factors(const Polynomial& p) {
  if (p.degree() < 1) return {};
  if (proved_coprime(p, p.derivative())) return {primitive_part(p)};
  Terms f = terms_of(p);
  make_primitive(f);
  const Terms df = derivative_of(f), repeated = common_divisor(f, df);
  Terms b = quotient(f, repeated), d = difference(quotient(df, repeated), derivative_of(b));
  std::vector<Polynomial> factors;
  while (b.size() > 1) {
    const Terms factor = common_divisor(b, d);
    b = quotient(std::move(b), factor);
    d = difference(quotient(std::move(d), factor), derivative_of(b));
    factors.push_back(polynomial(factor));
  }
  return factors;
}

}  // namespace dymsum::exact
