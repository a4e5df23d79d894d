#include "exact/root_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
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

}  // namespace dymsum::exact
