#include "exact/algebraic_root.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "exact/root_bracket.h"

namespace dymsum::exact {
namespace {

/// Compares by the bounds alone, if they are apart. Both bounds of a root equal it or are strictly beyond it.
std::optional<int> compare_bounds(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  const bool below = a.high() <= b.low(), above = b.high() <= a.low();
  if (below && above) return 0;
  if (below) return -1;
  if (above) return 1;
  return std::nullopt;
}

DyadicNumber larger(const DyadicNumber& a, const DyadicNumber& b) { return compare(a, b) < 0 ? b : a; }
DyadicNumber smaller(const DyadicNumber& a, const DyadicNumber& b) { return compare(a, b) < 0 ? a : b; }

int sign_at(const Polynomial& p, const DyadicNumber& x) { return p.value_at_dyadic(x.numerator, x.shift).sign(); }

/// The common divisor; constant without computing it when a prime shows that nothing is common.
Polynomial common_factor(const Polynomial& a, const Polynomial& b) {
  if (a == b) return a;
  if (proved_coprime(a, b)) return Polynomial({Big::from_int64(1)});
  return gcd(a, b);
}

/// Neither is a point. Where the brackets overlap a divisor of both polynomials has no root but the common one, a
/// simple root; at the ends of the overlap it is not 0, as one of the polynomials is not.
bool equal_roots(const RootBracket& a, const RootBracket& b) {
  const DyadicNumber low = larger(a.low(), b.low()), high = smaller(a.high(), b.high());
  if (compare(low, high) >= 0) return false;
  const Polynomial common = common_factor(a.polynomial(), b.polynomial());
  return common.degree() > 0 && sign_at(common, low) != sign_at(common, high);
}

/// Compares distinct roots. It ends once the brackets are apart.
int compare_distinct(RootBracket& a, RootBracket& b) {
  for (;;) {
    if (compare(a.high(), b.low()) <= 0) return -1;
    if (compare(b.high(), a.low()) <= 0) return 1;
    a.refine();
    b.refine();
  }
}

int exact_compare(RootBracket& a, RootBracket& b) {
  if (b.is_point()) return a.compare_to(b.low());
  if (a.is_point()) return -b.compare_to(a.low());
  return equal_roots(a, b) ? 0 : compare_distinct(a, b);
}

BigInteger floor_of(const BigRational& x) {
  const BigInteger n = numerator(x) / denominator(x);
  return x < 0 && BigRational(n) != x ? BigInteger(n - 1) : n;
}

BigRational width(const RootBracket& r) { return r.high().value() - r.low().value(); }

/// n / 2^k as for between(), for 0 <= low, if it has at most 52 bits and hence n and all products here are exact.
std::optional<double> simplest_between_positive(double low, double high) {
  const int last = 2 - std::ilogb(high - low);  // 2^-last is below half of high - low, also where that was rounded
  for (int k = 0; k <= last && k < 900; ++k) {
    const double scale = power_of_two(k), n = std::floor(low * scale) + 1;
    if (n >= 0x1p52) return std::nullopt;
    if (n < high * scale) return n / scale;
  }
  return std::nullopt;
}

/// The simplest number in the hull of both brackets, if it is in the gap.
std::optional<BigRational> filtered_between(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  const double low = a.low(), high = b.high();
  std::optional<double> x = 0.0;
  if (low >= 0) x = simplest_between_positive(low, high);
  if (high <= 0) x = simplest_between_positive(-high, -low);
  if (!x) return std::nullopt;
  const double midpoint = high <= 0 ? -*x : *x;
  // a bound that is not the root is strictly beyond it
  const bool above = a.high() < midpoint || (a.high() == midpoint && a.low() < a.high());
  const bool below = midpoint < b.low() || (midpoint == b.low() && b.low() < b.high());
  if (!above || !below) return std::nullopt;
  return exact_value(midpoint);
}

/// The one multiple of 1 / c in an open bracket narrower than 1 / c, if there is one. Requires c > 0.
std::optional<BigRational> candidate(const RootBracket& r, const BigInteger& c) {
  const BigRational x(BigInteger(floor_of(r.low().value() * c) + 1), c);
  return x < r.high().value() ? std::optional(x) : std::nullopt;
}

/// p = (2^s t - n)^multiplicity rest, for n / 2^s = x.
struct Deflated {
  Polynomial rest;
  int multiplicity = 0;
};

Deflated deflated(const Polynomial& p, double x) {
  const DyadicNumber at = DyadicNumber::of(x);
  Deflated d{p, 0};
  while (d.rest.degree() > 0 && sign_at(d.rest, at) == 0) {
    // The factor is primitive, so the quotient has integer coefficients (Gauss).
    std::vector<Big> quotient(static_cast<std::size_t>(d.rest.degree()));
    BigInteger carry = 0;
    for (int k = d.rest.degree(); k > 0; --k) {
      carry = (d.rest[k].value() + at.numerator * carry) >> at.shift;
      quotient[static_cast<std::size_t>(k - 1)] = Big(carry);
    }
    d.rest = Polynomial(std::move(quotient));
    ++d.multiplicity;
  }
  return d;
}

std::vector<AlgebraicRoot> merged(std::vector<AlgebraicRoot> roots) {
  std::sort(roots.begin(), roots.end(),
            [](const AlgebraicRoot& a, const AlgebraicRoot& b) { return compare(a, b) < 0; });
  return roots;
}

}  // namespace

AlgebraicRoot::AlgebraicRoot(Polynomial f, double low, double high) : f_(std::move(f)), low_(low), high_(high) {}

AlgebraicRoot::AlgebraicRoot(const RootBracket& bracket, int multiplicity)
    : f_(bracket.polynomial()), multiplicity_(multiplicity) {
  RootBracket narrow = bracket;
  narrow.refine_to_double();
  std::tie(low_, high_) = narrow.bounds();
  if (low_ != high_) bracket_ = std::make_shared<const RootBracket>(std::move(narrow));
}

AlgebraicRoot AlgebraicRoot::rational(const BigRational& x) {
  const Polynomial f({Big(BigInteger(-numerator(x))), Big(denominator(x))});
  const auto [low, high] = double_bounds(x);
  AlgebraicRoot root(f, low, high);
  if (!std::isfinite(low) || !std::isfinite(high)) {
    const BigInteger n = floor_of(x);
    root.bracket_ =
        std::make_shared<const RootBracket>(f, DyadicNumber{BigInteger(n - 1), 0}, DyadicNumber{BigInteger(n + 1), 0});
  }
  return root;
}

double AlgebraicRoot::approx() const {
  constexpr double kMost = std::numeric_limits<double>::max();
  const double low = std::max(low_, -kMost), high = std::min(high_, kMost);
  return low + (high / 2 - low / 2);
}

RootBracket AlgebraicRoot::bracket() const {
  if (bracket_) return *bracket_;
  if (low_ == high_) return {f_, DyadicNumber::of(low_)};
  return {f_, DyadicNumber::of(low_), DyadicNumber::of(high_)};
}

std::vector<AlgebraicRoot> roots_in(const Polynomial& p, double lo, double hi, RungCounts& counts) {
  if (!std::isfinite(lo) || !std::isfinite(hi)) throw std::domain_error("roots_in: the ends must be finite");
  std::vector<AlgebraicRoot> roots;
  if (p.is_zero() || lo >= hi) return roots;
  const auto add = [&](const Polynomial& f, const std::vector<DoubleBracket>& brackets) {
    counts.count(Rung::doubles);
    roots.reserve(brackets.size() + 1);
    for (const DoubleBracket& b : brackets) {
      const bool zero = b.low < 0 && b.high > 0 && sign(f[0]) == 0;
      roots.push_back(zero ? AlgebraicRoot(f, 0, 0) : AlgebraicRoot(f, b.low, b.high));
    }
  };
  if (const auto brackets = filtered_roots(p, lo, hi)) {
    add(p, *brackets);
    return roots;
  }
  // An end that is a root is divided out: events of axis-parallel shapes fall on the ends of ranges in hundreds.
  const Deflated low = deflated(p, lo), high = deflated(low.rest, hi);
  if (low.multiplicity + high.multiplicity > 0) {
    if (const auto brackets = filtered_roots(high.rest, lo, hi)) {
      add(high.rest, *brackets);
      if (high.multiplicity > 0) {
        roots.push_back(AlgebraicRoot::of(hi));
        roots.back().multiplicity_ = high.multiplicity;
      }
      return roots;
    }
  }
  counts.count(Rung::big);
  int multiplicity = 0;
  for (const Polynomial& f : square_free_factors(p)) {
    ++multiplicity;
    if (f.degree() < 1) continue;
    for (const RootBracket& b : isolated_roots(f, lo, hi)) roots.push_back(AlgebraicRoot(b, multiplicity));
  }
  return merged(std::move(roots));
}

std::vector<AlgebraicRoot> roots_in(const Polynomial& p, double lo, double hi) {
  RungCounts counts;
  return roots_in(p, lo, hi, counts);
}

SignAnswer compare_answer(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  if (const auto s = compare_bounds(a, b)) return {*s, Rung::doubles};
  RootBracket x = a.bracket(), y = b.bracket();
  return {exact_compare(x, y), Rung::big};
}

SignAnswer compare_answer(const AlgebraicRoot& a, double x) {
  if (a.low() > x) return {1, Rung::doubles};
  if (a.high() < x) return {-1, Rung::doubles};
  return compare_answer(a, AlgebraicRoot::of(x));
}

SignAnswer compare_answer(const AlgebraicRoot& a, const BigRational& x) {
  return compare_answer(a, AlgebraicRoot::rational(x));
}

SignAnswer sign_answer_at(const AlgebraicRoot& root, const Polynomial& p) {
  if (p.degree() < 1) return {p.is_zero() ? 0 : sign(p[0]), Rung::doubles};
  if (const auto s = filtered_sign(p, root.low(), root.high())) return {*s, Rung::doubles};
  RootBracket bracket = root.bracket();
  if (bracket.is_point()) return {sign_at(p, bracket.low()), Rung::big};
  const Polynomial common = common_factor(root.polynomial(), p);
  if (common.degree() > 0 && sign_at(common, bracket.low()) != sign_at(common, bracket.high())) return {0, Rung::big};
  return {sign_of_nonzero(bracket, p), Rung::big};
}

BigRational between(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  if (compare(a, b) >= 0) throw std::invalid_argument("between: requires a < b");
  if (const auto x = filtered_between(a, b)) return *x;
  RootBracket x = a.bracket(), y = b.bracket();
  x.refine_to(2);
  y.refine_to(2);
  compare_distinct(x, y);
  // Nothing simpler than the answer lies in the hull of the brackets but what is not between the roots. Brackets
  // narrower than the gap leave a few candidates; each one that is not between the roots cuts the hull and has a larger
  // denominator than the one before, or is one of at most two integers.
  while (width(x) + width(y) > y.low().value() - x.high().value()) {
    x.refine();
    y.refine();
  }
  DyadicNumber low = x.low(), high = y.high();
  for (;;) {
    const DyadicNumber midpoint = simplest_between(low, high);
    if (x.compare_to(midpoint) >= 0) {
      low = midpoint;
    } else if (y.compare_to(midpoint) <= 0) {
      high = midpoint;
    } else {
      return midpoint.value();
    }
  }
}

std::optional<BigRational> rational_value(const AlgebraicRoot& root) {
  RootBracket bracket = root.bracket();
  if (bracket.is_point()) return bracket.low().value();
  if (proved_without_rational_roots(root.polynomial())) return std::nullopt;
  const Polynomial f = primitive_part(root.polynomial());
  const BigInteger c = boost::multiprecision::abs(f[f.degree()].value());
  bracket.refine_to(static_cast<long>(msb(c)) + 2);
  if (bracket.is_point()) return bracket.low().value();
  const auto x = candidate(bracket, c);
  if (x && f.sign_at(*x) == 0) return x;
  return std::nullopt;
}

namespace {

void drop_zeros(Terms& terms) {
  while (!terms.empty() && terms.back().is_zero()) terms.pop_back();
}

/// a becomes a positive multiple of a less a multiple of b, of a degree below b's.
void take_remainder(Terms& a, const Polynomial& b) {
  const auto degree = static_cast<std::size_t>(b.degree());
  const BigInteger lead = b[b.degree()].value(), size = abs(lead);
  while (a.size() > degree) {
    const BigInteger factor = lead.sign() > 0 ? a.back() : BigInteger(-a.back());
    const std::size_t offset = a.size() - 1 - degree;
    for (BigInteger& c : a) c *= size;
    for (std::size_t k = 0; k <= degree; ++k) a[offset + k] -= factor * b[static_cast<int>(k)].value();
    drop_zeros(a);
  }
}

Polynomial polynomial_of(const Terms& terms) {
  std::vector<Big> c;
  for (const BigInteger& term : terms) c.emplace_back(term);
  return Polynomial(std::move(c));
}

}  // namespace

Terms sum_of(const Terms& a, const Terms& b) {
  if (a.size() < b.size()) return sum_of(b, a);
  Terms s = a;
  for (std::size_t k = 0; k < b.size(); ++k) s[k] += b[k];
  drop_zeros(s);
  return s;
}

Terms difference_of(const Terms& a, const Terms& b) {
  Terms s = a;
  s.resize(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) s[k] -= b[k];
  drop_zeros(s);
  return s;
}

Terms product_of(const Terms& a, const Terms& b) {
  if (a.empty() || b.empty()) return {};
  Terms s(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) s[i + j] += a[i] * b[j];
  return s;
}

bool divide_exactly(Terms& a, const Terms& b) {
  if (a.size() < b.size()) return false;
  Terms rest = a, quotient(a.size() - b.size() + 1);
  for (std::size_t k = quotient.size(); k-- > 0;) {
    BigInteger remainder;
    divide_qr(rest[k + b.size() - 1], b.back(), quotient[k], remainder);
    if (!remainder.is_zero()) return false;
    for (std::size_t j = 0; j < b.size(); ++j) rest[k + j] -= quotient[k] * b[j];
  }
  drop_zeros(rest);
  if (!rest.empty()) return false;
  a = std::move(quotient);
  return true;
}

RootPoint::RootPoint(const AlgebraicRoot& root) : root_(root), bracket_(root.bracket()) {}

RootPoint::Enclosure RootPoint::enclose(const Terms& p, unsigned bits) const {
  if (!bracket_.is_point()) bracket_.refine_to(static_cast<long>(bits));
  const DyadicNumber low = bracket_.low(), high = bracket_.high();
  const unsigned shift = std::max(low.shift, high.shift);
  const BigInteger x = low.numerator << (shift - low.shift), end = high.numerator << (shift - high.shift);
  // |p(root) - p(low)| <= (high - low) sum k |c_k| most^(k - 1), most >= |low|, |high|, 1.
  const BigInteger most = (std::max<BigInteger>(abs(x), abs(end)) >> shift) + 1;
  Enclosure e;
  BigInteger power = 1, slope = 0;
  for (std::size_t k = p.size(); k-- > 0;) e.value = e.value * x + (p[k] << (shift * (p.size() - 1 - k)));
  for (std::size_t k = 1; k < p.size(); ++k, power *= most) slope += static_cast<std::uint64_t>(k) * abs(p[k]) * power;
  e.scale = p.empty() ? 0 : shift * (p.size() - 1);
  e.error = p.size() < 2 ? BigInteger(0) : BigInteger((slope * (end - x)) << (shift * (p.size() - 2)));
  return e;
}

int RootPoint::sign_of(const Terms& p) const {
  if (p.empty()) return 0;
  if (p.size() == 1) return p[0].sign();
  const Enclosure e = enclose(p, 160);
  if (abs(e.value) > e.error) return e.value.sign();
  Terms rest = p;
  take_remainder(rest, root_.polynomial());
  return rest.empty() ? 0 : sign_at(root_, polynomial_of(rest));
}

double RootPoint::nearest(const Terms& p) const {
  if (sign_of(p) == 0) return 0;
  for (unsigned bits = 160;; bits *= 2) {
    const Enclosure e = enclose(p, bits);
    if (abs(e.value) > e.error << 54) return round_to_double(e.value, BigInteger(BigInteger(1) << e.scale));
  }
}

bool operator==(const RootValue& a, const RootValue& b) { return sign(a - b) == 0; }

int sign(const RootValue& v) {
  if (v.at() != nullptr) return v.at()->sign_of(v.terms());
  if (v.terms().size() > 1) throw std::logic_error("RootValue: the sign of a polynomial nowhere");
  return v.terms().empty() ? 0 : v.terms()[0].sign();
}

double to_double(const RootValue& v) {
  if (v.at() != nullptr) return v.at()->nearest(v.terms());
  if (v.terms().size() > 1) throw std::logic_error("RootValue: the value of a polynomial nowhere");
  return v.terms().empty() ? 0 : round_to_double(v.terms()[0], BigInteger(1));
}

Big to_big(const RootValue&) { throw std::logic_error("RootValue: a value at a root is no integer"); }

}  // namespace dymsum::exact
