#include "exact/root_bracket.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace dymsum::exact {
namespace {

BigInteger magnitude(const BigInteger& v) { return boost::multiprecision::abs(v); }

/// The largest integer that is at most v / 2^shift.
BigInteger floor_shift(const BigInteger& v, unsigned shift) {
  if (v.sign() >= 0) return v >> shift;
  const BigInteger up = (BigInteger(1) << shift) - 1;
  return -BigInteger(BigInteger(up - v) >> shift);
}

/// f, f', then negated remainders: for square-free f, the variations of their signs at a less those at b are the number
/// of roots in (a, b].
class SturmChain {
 public:
  explicit SturmChain(const Polynomial& f) : chain_{f, primitive_part(f.derivative())} {
    while (chain_.back().degree() > 0)
      chain_.push_back(negated(pseudo_remainder(chain_[chain_.size() - 2], chain_.back())));
  }
  int variations(const BigInteger& x, unsigned shift) const {
    int count = 0, previous = 0;
    for (const Polynomial& p : chain_) {
      const int s = p.value_at_dyadic(x, shift).sign();
      count += s * previous < 0;
      if (s != 0) previous = s;
    }
    return count;
  }

 private:
  static Polynomial negated(const Polynomial& p) {
    std::vector<Big> c;
    for (int k = 0; k <= p.degree(); ++k) c.push_back(-p[k]);
    return Polynomial(std::move(c));
  }
  std::vector<Polynomial> chain_;
};

/// (low, high] / 2^shift with the variations at its ends.
struct Isolating {
  BigInteger low, high;
  unsigned shift;
  int low_variations, high_variations;
};

struct Halves {
  Isolating left, right;
};

Halves halves(const SturmChain& chain, const Isolating& i) {
  const BigInteger midpoint = i.low + i.high;
  const unsigned shift = i.shift + 1;
  const int v = chain.variations(midpoint, shift);
  return {{BigInteger(i.low << 1), midpoint, shift, i.low_variations, v},
          {midpoint, BigInteger(i.high << 1), shift, v, i.high_variations}};
}

/// The one root in (low, high], which is not low: halved until low is not another root, unless high is the root.
RootBracket bracket_in(const Polynomial& f, const SturmChain& chain, Isolating i) {
  for (;;) {
    if (f.value_at_dyadic(i.high, i.shift).is_zero()) return {f, {i.high, i.shift}};
    if (!f.value_at_dyadic(i.low, i.shift).is_zero()) return {f, {i.low, i.shift}, {i.high, i.shift}};
    Halves h = halves(chain, i);
    i = h.left.low_variations != h.left.high_variations ? std::move(h.left) : std::move(h.right);
  }
}

/// The coefficients of 2^(shift n) p((x + t) / 2^shift) in t.
std::vector<BigInteger> shifted(const Polynomial& p, const BigInteger& x, unsigned shift) {
  const int n = p.degree();
  std::vector<BigInteger> c;
  for (int k = 0; k <= n; ++k) c.push_back(p[k].value() << shift * static_cast<unsigned>(n - k));
  for (std::size_t i = 0; i + 1 < c.size(); ++i)
    for (std::size_t k = c.size() - 1; k-- > i;) c[k] += x * c[k + 1];
  return c;
}

/// The sign that p has on all of [low, high], or 0: |p(x + t) - p(x)| <= sum |c_k| r^k for |t| <= r.
int constant_sign(const Polynomial& p, const BigInteger& low, const BigInteger& high, unsigned shift) {
  const std::vector<BigInteger> c = shifted(p, low + high, shift + 1);
  const BigInteger radius = high - low;
  BigInteger change = 0;
  for (std::size_t k = c.size(); k-- > 1;) change = (change + magnitude(c[k])) * radius;
  return magnitude(c[0]) > change ? c[0].sign() : 0;
}

}  // namespace

DyadicNumber DyadicNumber::of(double v) {
  if (!std::isfinite(v)) throw std::domain_error("DyadicNumber::of: not a finite number");
  if (v == 0) return {};
  int e = 0;
  auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &e), 53));
  e -= 53;
  if (e >= 0) return {BigInteger(BigInteger(m) << static_cast<unsigned>(e)), 0};
  const int common = std::min(std::countr_zero(static_cast<std::uint64_t>(m)), -e);
  return {BigInteger(m >> common), static_cast<unsigned>(-e - common)};
}

int compare(const DyadicNumber& a, const DyadicNumber& b) {
  if (a.shift == b.shift) return a.numerator.compare(b.numerator);
  if (a.shift < b.shift) return BigInteger(a.numerator << (b.shift - a.shift)).compare(b.numerator);
  return a.numerator.compare(BigInteger(b.numerator << (a.shift - b.shift)));
}

std::pair<double, double> double_bounds(const BigRational& v) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = round_to_double(v);
  const int side = std::isinf(nearest) ? (nearest > 0 ? -1 : 1) : v.compare(exact_value(nearest));
  if (side == 0) return {nearest, nearest};
  if (side < 0) return {std::nextafter(nearest, -kInfinity), nearest};
  return {nearest, std::nextafter(nearest, kInfinity)};
}

DyadicNumber simplest_between(const DyadicNumber& low, const DyadicNumber& high) {
  const unsigned shift = std::max(low.shift, high.shift);
  const BigInteger l = low.numerator << (shift - low.shift), h = high.numerator << (shift - high.shift);
  if (l.sign() < 0 && h.sign() > 0) return {0, 0};
  if (h.sign() <= 0) {
    DyadicNumber mirrored = simplest_between({BigInteger(-h), shift}, {BigInteger(-l), shift});
    return {BigInteger(-mirrored.numerator), mirrored.shift};
  }
  for (unsigned drop = shift;; --drop) {
    BigInteger n = floor_shift(l, drop) + 1;
    if (BigInteger(n << drop) < h) return {std::move(n), shift - drop};
    if (drop == 0) return {BigInteger(l + h), shift + 1};  // neighbours: the midpoint
  }
}

RootBracket::RootBracket(Polynomial f, const DyadicNumber& low, const DyadicNumber& high)
    : f_(std::move(f)), shift_(std::max(low.shift, high.shift)) {
  low_ = low.numerator << (shift_ - low.shift);
  high_ = high.numerator << (shift_ - high.shift);
  low_sign_ = sign(low_);
  // In a narrow bracket f is nearly linear: the first step may try as many bits as half of those that are known.
  const long known = static_cast<long>(shift_) - static_cast<long>(msb(BigInteger(high_ - low_)));
  gain_ = static_cast<unsigned>(std::clamp(known / 2, 1L, 64L));
}

RootBracket::RootBracket(Polynomial f, const DyadicNumber& x)
    : f_(std::move(f)), low_(x.numerator), high_(x.numerator), shift_(x.shift) {}

void RootBracket::rescale(unsigned more) {
  low_ <<= more;
  high_ <<= more;
  shift_ += more;
}

/// Drops common factors of 2.
void RootBracket::reduce() {
  unsigned common = shift_;
  if (!low_.is_zero()) common = std::min(common, static_cast<unsigned>(lsb(magnitude(low_))));
  if (!high_.is_zero()) common = std::min(common, static_cast<unsigned>(lsb(magnitude(high_))));
  low_ = floor_shift(low_, common);
  high_ = floor_shift(high_, common);
  shift_ -= common;
}

void RootBracket::become_point(const BigInteger& numerator) {
  low_ = high_ = BigInteger(numerator);
  reduce();
}

/// Moves an end to each of left and left + width; true when the bracket is now between them or a point. Requires both
/// in [low, high].
bool RootBracket::narrow_towards(const BigInteger& left, const BigInteger& width) {
  const BigInteger right = left + width;
  for (const BigInteger& x : {left, right}) {
    if (x == low_ || x == high_) continue;  // its sign is known
    const int s = sign(x);
    if (s == 0) {
      become_point(x);
      return true;
    }
    if (s != low_sign_) {
      high_ = x;
      break;
    }
    low_ = x;
  }
  return low_ == left && high_ == right;
}

void RootBracket::refine() {
  if (is_point()) return;
  // The root of the chord, rounded to one of 2^gain - 1 inner marks, and the side of it the root lies on. With two
  // parts the mark is the midpoint, and the step cannot fail.
  const BigInteger at_low = magnitude(f_.value_at_dyadic(low_, shift_));
  const BigInteger at_high = magnitude(f_.value_at_dyadic(high_, shift_));
  const BigInteger width = high_ - low_, parts = BigInteger(1) << gain_, sum = at_low + at_high;
  BigInteger index = ((at_low << (gain_ + 1)) + sum) / (sum << 1);
  if (index < 1) index = 1;
  if (index >= parts) index = parts - 1;
  rescale(gain_);
  const BigInteger mark = low_ + index * width;
  const int s = sign(mark);
  if (s == 0) return become_point(mark);
  (s == low_sign_ ? low_ : high_) = mark;
  const bool success = narrow_towards(s == low_sign_ ? mark : BigInteger(mark - width), width);
  gain_ = success ? std::min(2 * gain_, 512u) : std::max(1u, gain_ / 2);
  reduce();
}

void RootBracket::refine_to(long bits) {
  while (!is_point()) {
    const BigInteger width = high_ - low_;
    if (static_cast<long>(msb(width)) + bits < static_cast<long>(shift_)) return;
    refine();
  }
}

void RootBracket::refine_to_double() {
  if (compare_to({0, 0}) == 0) return;
  const auto wide = [this] {
    return BigInteger(BigInteger(high_ - low_) << 53) > std::min(magnitude(low_), magnitude(high_));
  };
  while (!is_point() && wide()) refine();
  if (is_point()) return;
  const double candidate = round_to_double(DyadicNumber{BigInteger(low_ + high_), shift_ + 1}.value());
  if (std::isfinite(candidate)) compare_to(DyadicNumber::of(candidate));
}

int RootBracket::compare_to(const DyadicNumber& x) {
  const int against_low = exact::compare(x, low()), against_high = exact::compare(x, high());
  if (is_point()) return -against_low;
  if (against_low <= 0) return 1;
  if (against_high >= 0) return -1;
  if (x.shift > shift_) rescale(x.shift - shift_);
  const BigInteger numerator = x.numerator << (shift_ - x.shift);
  const int s = sign(numerator);
  if (s == 0) {
    become_point(numerator);
    return 0;
  }
  (s == low_sign_ ? low_ : high_) = numerator;
  return s == low_sign_ ? 1 : -1;
}

std::pair<double, double> RootBracket::bounds() const {
  return {double_bounds(low().value()).first, double_bounds(high().value()).second};
}

std::vector<RootBracket> isolated_roots(const Polynomial& f, double lo, double hi) {
  const SturmChain chain(f);
  const DyadicNumber from = DyadicNumber::of(lo), to = DyadicNumber::of(hi);
  const unsigned shift = std::max(from.shift, to.shift);
  const BigInteger low = from.numerator << (shift - from.shift), high = to.numerator << (shift - to.shift);
  std::vector<Isolating> waiting{{low, high, shift, chain.variations(low, shift), chain.variations(high, shift)}};
  std::vector<RootBracket> roots;
  while (!waiting.empty()) {
    const Isolating i = std::move(waiting.back());
    waiting.pop_back();
    const int count = i.low_variations - i.high_variations;
    if (count == 1) roots.push_back(bracket_in(f, chain, i));
    if (count <= 1) continue;
    Halves h = halves(chain, i);
    waiting.push_back(std::move(h.right));
    waiting.push_back(std::move(h.left));
  }
  return roots;
}

int sign_of_nonzero(RootBracket& root, const Polynomial& p) {
  for (;;) {
    const DyadicNumber low = root.low(), high = root.high();
    if (const int s = constant_sign(p, low.numerator, high.numerator, low.shift)) return s;
    root.refine();
  }
}

}  // namespace dymsum::exact
