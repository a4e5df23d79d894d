#include "exact/root_bracket.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "exact/rounding_bound.h"

namespace dymsum::exact {
namespace {

/// More than what underflow can change: below |t| = kLargestArgument, 2^-1022 for each coefficient and operation grows
/// by less than 2^(6 * 65 + 20).
constexpr double kFilterUnderflow = 0x1p-600, kLargestArgument = 0x1p64;
/// Generic polynomials need fewer than ten; those with multiple roots would never end.
constexpr int kMaxIntervals = 48;

/// 0 for an open sign.
int decided(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

/// Value, slope and the error of the value: with M the sum of |c_k t^k|, 4 units of M for the coefficients and 2 n for
/// Horner's scheme (Higham, Accuracy and Stability, 5.1); 2 more cover the rounding of M and the second order.
struct Evaluation {
  double value = 0, slope = 0, error = 0;
  int sign() const { return decided(value, error); }
};

Evaluation evaluate(const Polynomial& p, double t) {
  const auto& c = p.approx();
  const int n = p.degree();
  const double size = std::abs(t);
  Evaluation e;
  double magnitude = 0;
  for (int k = n; k >= 0; --k) {
    const double a = c[static_cast<std::size_t>(k)];
    e.slope = e.slope * t + e.value;
    e.value = e.value * t + a;
    magnitude = magnitude * size + std::abs(a);
  }
  e.error = (2 * n + 6) * kRoundoff * magnitude + kFilterUnderflow;
  return e;
}

constexpr std::array<std::array<double, 7>, 7> kBinomials = {
    {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}, {1, 6, 15, 20, 15, 6, 1}}};

/// An interval where p is to be searched; its signs at the ends are proved.
struct FilteredInterval {
  DoubleBracket ends;
  int low_sign = 0, high_sign = 0;
};

/// The signs, 0 where open, of the Bernstein coefficients on an interval [l, h].
/// With w = h - l: the coefficients of p(l + w x) by n shifts (2 n roundings at most for each product of terms), times
/// powers of w (2 n with the rounding of w itself, 1 more), then shifted by 1 in reverse order (n): binomial(n, j)
/// times the Bernstein coefficients. With 4 for the coefficients of p that is 5 n + 5 units of the same computation on
/// magnitudes, whose Bernstein coefficients are at most the value of sum |c_k| x^k at |l| + w. 3 more cover the
/// rounding of that value and the second order.
/// The first and the last coefficient are values of p.
std::array<int, 7> bernstein_signs(const Polynomial& p, const FilteredInterval& interval) {
  const auto n = static_cast<std::size_t>(p.degree());
  auto c = p.approx();
  const double l = interval.ends.low, w = interval.ends.high - l, reach = std::abs(l) + w;
  double bound = 0;
  for (std::size_t k = n + 1; k-- > 0;) bound = bound * reach + std::abs(c[k]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = n; k-- > i;) c[k] += l * c[k + 1];
  double power = 1;
  for (std::size_t k = 1; k <= n; ++k) c[k] *= power *= w;
  std::reverse(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(n) + 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = n; k-- > i;) c[k] += c[k + 1];
  // c[n - j] belongs to the j-th Bernstein coefficient
  const double error = (5 * static_cast<double>(n) + 8) * kRoundoff * bound + kFilterUnderflow;
  std::array<int, 7> signs{};
  for (std::size_t j = 1; j < n; ++j) signs[j] = decided(c[n - j], kBinomials[n][j] * error);
  signs[0] = interval.low_sign;
  signs[n] = interval.high_sign;
  return signs;
}

enum class Content { none, one, unknown };

/// Descartes' rule: no change of sign, no root; one change, one simple root. A single open sign between opposite ones
/// changes nothing.
Content content(const std::array<int, 7>& signs, std::size_t n) {
  int changes = 0, previous = signs[0];
  for (std::size_t j = 1; j <= n; ++j) {
    if (signs[j] == 0) {
      if (signs[j + 1] != -previous) return Content::unknown;
      continue;
    }
    changes += signs[j] != previous;
    previous = signs[j];
  }
  return changes == 0 ? Content::none : changes == 1 ? Content::one : Content::unknown;
}

/// Moves the end of a bracket to x where the sign is proved. False where it is open.
bool tighten(DoubleBracket& bracket, double x, int sign_at_x, int low_sign) {
  if (sign_at_x == 0) return false;
  (sign_at_x == low_sign ? bracket.low : bracket.high) = x;
  return true;
}

/// Newton's iteration inside the bracket, halving where it would leave; ends where signs are open or steps are small.
double approach(const Polynomial& p, DoubleBracket& bracket, int low_sign, double& radius) {
  double x = bracket.low + (bracket.high - bracket.low) / 2;
  for (int i = 0; i < 60; ++i) {
    const Evaluation e = evaluate(p, x);
    radius = 1.5 * e.error / std::abs(e.slope) + 2 * kRoundoff * std::abs(x);
    if (!tighten(bracket, x, e.sign(), low_sign)) break;
    const double next = x - e.value / e.slope;
    const bool inside = next > bracket.low && next < bracket.high;
    const double step = std::abs(next - x);
    x = inside ? next : bracket.low + (bracket.high - bracket.low) / 2;
    if (inside && step < radius) break;
  }
  return x;
}

/// The bracket narrowed around its root. Every end it ever has carries a proved sign.
DoubleBracket narrowed(const Polynomial& p, DoubleBracket bracket, int low_sign) {
  double radius = 0;
  const double x = approach(p, bracket, low_sign, radius);
  for (int i = 0; i < 8; ++i, radius *= 2) {
    const double left = x - radius, right = x + radius;
    bool done = true;
    if (left > bracket.low) done &= tighten(bracket, left, evaluate(p, left).sign(), low_sign);
    if (right < bracket.high) done &= tighten(bracket, right, evaluate(p, right).sign(), low_sign);
    if (done) break;
  }
  return bracket;
}

/// Both parts of an interval, if p is provably not 0 where it is divided: not in the middle, which is where roots
/// of simple polynomials lie.
std::optional<std::pair<FilteredInterval, FilteredInterval>> divided(const Polynomial& p, const FilteredInterval& i) {
  for (const double fraction : {0.4873, 0.6127}) {
    const double x = i.ends.low + fraction * (i.ends.high - i.ends.low);
    if (!(i.ends.low < x && x < i.ends.high)) return std::nullopt;
    const int sign = evaluate(p, x).sign();
    if (sign == 0) continue;
    return std::pair{FilteredInterval{{i.ends.low, x}, i.low_sign, sign},
                     FilteredInterval{{x, i.ends.high}, sign, i.high_sign}};
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> filtered_sign(const Polynomial& p, double low, double high) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(size <= kLargestArgument)) return std::nullopt;
  const double midpoint = low + (high - low) / 2;
  const Evaluation e = evaluate(p, midpoint);
  // |p(t) - p(midpoint)| <= |t - midpoint| sum k |c_k| size^(k - 1); kOutwards covers all roundings of that product and
  // two units of size those of the midpoint.
  double slope = 0;
  for (int k = p.degree(); k > 0; --k) slope = slope * size + k * std::abs(p.approx()[static_cast<std::size_t>(k)]);
  const double radius = (high - low) / 2 + 2 * kRoundoff * size;
  const int sign = decided(e.value, e.error + radius * slope * kOutwards + kFilterUnderflow);
  return sign == 0 ? std::nullopt : std::optional(sign);
}

std::optional<std::vector<DoubleBracket>> filtered_roots(const Polynomial& p, double lo, double hi) {
  if (p.is_zero() || !(std::max(std::abs(lo), std::abs(hi)) <= kLargestArgument)) return std::nullopt;
  std::vector<DoubleBracket> roots;
  std::array<FilteredInterval, kMaxIntervals + 2> waiting;  // the leftmost last
  std::size_t count = 0;
  waiting[count++] = {{lo, hi}, evaluate(p, lo).sign(), evaluate(p, hi).sign()};
  if (waiting[0].low_sign == 0 || waiting[0].high_sign == 0) return std::nullopt;
  for (int i = 0; count > 0; ++i) {
    if (i == kMaxIntervals) return std::nullopt;
    const FilteredInterval interval = waiting[--count];
    const Content found = content(bernstein_signs(p, interval), static_cast<std::size_t>(p.degree()));
    if (found == Content::one) roots.push_back(narrowed(p, interval.ends, interval.low_sign));
    if (found != Content::unknown) continue;
    const auto parts = divided(p, interval);
    if (!parts) return std::nullopt;
    waiting[count++] = parts->second;
    waiting[count++] = parts->first;
  }
  return roots;
}

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
