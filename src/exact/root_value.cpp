#include "exact/root_value.h"

#include <algorithm>
#include <stdexcept>

namespace dymsum::exact {

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
