#include "cspace/events/near_angle.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

double low_of(const RotationRange& r) { return r.theta(r.t_low) - kAngleDouble; }
double high_of(const RotationRange& r) { return r.theta(r.t_high) + kAngleDouble; }

}  // namespace

EventWindow::EventWindow(const RotationGrid& grid, const RotationCatalog& catalog, const RotationRange& r, bool mask)
    : RotatingWindow(grid, catalog, (low_of(r) + high_of(r)) / 2, (high_of(r) - low_of(r)) / 2, mask),
      range(r),
      low(low_of(r)),
      high(high_of(r)) {
  pairs.reserve(candidates.size());
  for (const RotationCandidate& c : candidates)
    pairs.push_back({std::min(segment_of(c.a), segment_of(c.b)), std::max(segment_of(c.a), segment_of(c.b))});
  sort_pairs();
}

// Sorts pairs into one list per first segment, which are short; without what several pieces of two segments say twice.
void EventWindow::sort_pairs() {
  pairs_of_.assign(segments.size() + 1, 0);
  for (const SegmentPair& p : pairs) ++pairs_of_[p.a + 1];
  for (std::size_t a = 0; a < segments.size(); ++a) pairs_of_[a + 1] += pairs_of_[a];
  std::vector<std::uint32_t> others(pairs.size()), fill(pairs_of_.begin(), pairs_of_.end() - 1);
  for (const SegmentPair& p : pairs) others[fill[p.a]++] = p.b;
  pairs.clear();
  for (std::uint32_t a = 0; a < segments.size(); ++a) {
    const auto first = others.begin() + pairs_of_[a], last = others.begin() + fill[a];
    std::sort(first, last);
    pairs_of_[a] = static_cast<std::uint32_t>(pairs.size());
    for (auto b = first; b != last; ++b)
      if (b == first || *b != b[-1]) pairs.push_back({a, *b});
  }
  pairs_of_[segments.size()] = static_cast<std::uint32_t>(pairs.size());
}

bool EventWindow::meet(std::uint32_t a, std::uint32_t b) const {
  const auto first = pairs.begin() + pairs_of_[a], last = pairs.begin() + pairs_of_[a + 1];
  return std::binary_search(first, last, SegmentPair{a, b});
}

using base::DoublePair;
using exact::BigInteger;

namespace {

/// The error of a polynomial's values in doubles is this times the sum of its terms' magnitudes: products, sums and
/// powers, a dozen roundings of 2^-53 each.
constexpr double kTerms = 0x1p-48;

/// The error of an integer as a double, relatively.
constexpr double kRounded = 0x1p-51;

NearPolynomial::Value value_of(const NearPolynomial& p, double u, double most) {
  NearPolynomial::Value v;
  double size = 0;
  for (int k = p.degree; k >= 0; --k) {
    v.at = v.at * u + p.c[static_cast<std::size_t>(k)];
    size = size * most + std::abs(p.c[static_cast<std::size_t>(k)]);
    v.error = v.error * most + p.error[static_cast<std::size_t>(k)];
  }
  v.error = (v.error + kTerms * size) * exact::kOutwards;
  return v;
}

/// The value of sum k |c_k| most^(k - 1).
double steepest(const NearPolynomial& p, double most) {
  double s = 0;
  for (int k = p.degree; k >= 1; --k)
    s = s * most + k * (std::abs(p.c[static_cast<std::size_t>(k)]) + p.error[static_cast<std::size_t>(k)]);
  return s * (1 + 0x1p-40);
}

/// Bernstein's coefficients on [low, high]: the values lie between the smallest and the largest one.
struct Bernstein {
  std::array<double, 5> b{};
  double error = 0;
  int degree = 0;

  Bernstein(const NearPolynomial& p, double low, double high) : degree(p.degree) {
    const auto n = static_cast<std::size_t>(p.degree);
    // Taylor's coefficients at `low`, times powers of the width.
    std::array<double, 5> a = p.c;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = n; j-- > k;) a[j] += low * a[j + 1];
    double power = 1;
    for (std::size_t k = 0; k <= n; ++k, power *= high - low) a[k] *= power;
    static constexpr std::array<std::array<double, 5>, 5> kBinomial{
        {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}}};
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= i; ++j) b[i] += kBinomial[i][j] / kBinomial[n][j] * a[j];
    const double most = std::max(std::abs(low), std::abs(high));
    double size = 0, off = 0;
    for (std::size_t k = n + 1; k-- > 0;) {
      size = size * (3 * most) + std::abs(p.c[k]);
      off = off * (3 * most) + p.error[k];
    }
    // Taylor's coefficients at `low` times powers of the width add up to those of (|low| + |width|)^k: up to 3 most.
    error = (off + 0x1p-46 * size) * exact::kOutwards;
  }
  int sign() const {
    const auto [least, most] = std::minmax_element(b.begin(), b.begin() + degree + 1);
    return *least > error ? 1 : *most < -error ? -1 : 0;
  }
  double most() const {
    double m = 0;
    for (const double v : b) m = std::max(m, std::abs(v));
    return m;
  }
  /// A bound from below on |slope| times the width, with the slope's sign; 0 where it may vanish.
  double slope() const {
    double least = INFINITY, most = -INFINITY;
    for (int k = 0; k < degree; ++k) {
      const double d = degree * (b[static_cast<std::size_t>(k + 1)] - b[static_cast<std::size_t>(k)]);
      least = std::min(least, d);
      most = std::max(most, d);
    }
    const double off = 2 * degree * error;
    return least > off ? least - off : most < -off ? most + off : 0;
  }
};

/// The parameter at which to divide: zero, else one between in powers, so that roots of any size are found in a few
/// steps.
double divide(double low, double high) {
  constexpr double kLeast = 0x1p-100;
  if (low < 0 && high > 0) return 0;
  if (high <= 0) return -divide(-high, -low);
  if (high <= 4 * low) return 0.5 * (low + high);
  return std::sqrt(std::max(low, std::min(kLeast, high * 0x1p-20)) * high);
}

/// The root of a monotone polynomial with different signs at the ends; `slope`: the least one.
NearRoot single_root(const NearPolynomial& p, double low, double high, double slope) {
  const int rising = slope > 0 ? 1 : -1;
  double x = divide(low, high);
  for (int step = 0; step < 64; ++step) {
    const NearPolynomial::Value v = p(x);
    if (v.sign() == 0) {
      const double off = 2 * v.error / std::abs(slope) * exact::kOutwards;
      return {std::max(low, x - off), std::min(high, x + off)};
    }
    (v.sign() == rising ? high : low) = x;
    if (high - low <= 0x1p-36 * std::max(std::abs(low), std::abs(high))) break;
    double d = 0;
    for (int k = p.degree; k >= 1; --k) d = d * x + k * p.c[static_cast<std::size_t>(k)];
    const double newton = x - v.at / d;
    // A little beyond, so that the next step brackets the root from its other side.
    const double beyond = newton + (newton - x) * 0x1p-38 + (newton > x ? 1 : -1) * 0x1p-40 * std::abs(newton);
    x = beyond > low && beyond < high ? beyond : divide(low, high);
    if (!(x > low && x < high)) break;
  }
  return {low, high};
}

constexpr std::size_t kMostRoots = 8;

void add_roots(const NearPolynomial& p, double low, double high, int depth, std::vector<NearRoot>& roots) {
  const Bernstein on(p, low, high);
  if (on.sign() != 0) return;
  // Never zero or always, or an interval in which nothing is known.
  if (on.most() <= 4 * on.error) return roots.push_back({low, high});
  if (const double slope = on.slope(); slope != 0) {
    const int at_low = p(low).sign(), at_high = p(high).sign();
    if (at_low != 0 && at_low == at_high) return;
    if (at_low != 0 && at_high != 0) return roots.push_back(single_root(p, low, high, slope / (high - low)));
    // A root may be at an end, as far as is known: nearer to it more is.
    const double least = std::abs(slope) / (high - low);
    for (const bool at_end : {false, true}) {
      if ((at_end ? at_high : at_low) != 0) continue;
      const double off = 4 * p(at_end ? high : low).error / least * exact::kOutwards,
                   from = at_end ? std::max(low, high - off) : low, to = at_end ? high : std::min(high, low + off);
      if (depth > 0 && to - from < 0.5 * (high - low)) add_roots(p, from, to, depth - 1, roots);
      else roots.push_back({from, to});
    }
    return;
  }
  const double midpoint = divide(low, high);
  if (depth == 0 || roots.size() > kMostRoots || !(midpoint > low && midpoint < high))
    return roots.push_back({low, high});
  add_roots(p, low, midpoint, depth - 1, roots);
  add_roots(p, midpoint, high, depth - 1, roots);
}

/// Pairs of doubles hold an integer within 2^-106 of it.
DoublePair pair_of(const BigInteger& v, int shift) {
  const double high = exact::to_double(exact::Big(v));
  const BigInteger rest = v - BigInteger(exact::numerator_of(exact::to_rational(exact::exact_value(high))));
  return {std::ldexp(high, shift), std::ldexp(exact::to_double(exact::Big(rest)), shift)};
}

}  // namespace

void NearPolynomial::divide() {
  for (std::size_t k = 0; k < 4; ++k) {
    c[k] = c[k + 1];
    error[k] = error[k + 1];
  }
  c[4] = error[4] = 0;
  --degree;
}

NearPolynomial::Value NearPolynomial::operator()(double u) const { return value_of(*this, u, std::abs(u)); }

NearPolynomial::Value NearPolynomial::within(double low, double high) const {
  const double midpoint = low + 0.5 * (high - low), most = std::max(std::abs(low), std::abs(high));
  Value v = value_of(*this, midpoint, most);
  v.error += steepest(*this, most) * (high - low);
  return v;
}

NearPolynomial difference_of_products(const NearPolynomial& x, const NearPolynomial& y, const NearPolynomial& z,
                                      const NearPolynomial& w) {
  NearPolynomial r;
  r.degree = 4;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      r.c[i + j] += x.c[i] * y.c[j] - z.c[i] * w.c[j];
      r.error[i + j] += std::abs(x.c[i]) * y.error[j] + x.error[i] * (std::abs(y.c[j]) + y.error[j]) +
                        std::abs(z.c[i]) * w.error[j] + z.error[i] * (std::abs(w.c[j]) + w.error[j]) +
                        0x1p-50 * (std::abs(x.c[i] * y.c[j]) + std::abs(z.c[i] * w.c[j]));
    }
  return r;
}

NearPolynomial ExactQuadratic::polynomial() const {
  NearPolynomial p;
  p.degree = 2;
  for (std::size_t k = 0; k < 3; ++k) {
    p.c[k] = exact::to_double(c[k]);
    p.error[k] = std::abs(p.c[k]) * kRounded;
  }
  return p;
}

NearPolynomial difference_of_products(const ExactQuadratic& x, const ExactQuadratic& y, const ExactQuadratic& z,
                                      const ExactQuadratic& w) {
  const auto term = [&](std::size_t i, std::size_t j) { return x.c[i] * y.c[j] - z.c[i] * w.c[j]; };
  NearPolynomial p;
  p.degree = 4;
  p.c = {exact::to_double(term(0, 0)), exact::to_double(term(0, 1) + term(1, 0)),
         exact::to_double(term(0, 2) + term(1, 1) + term(2, 0)), exact::to_double(term(1, 2) + term(2, 1)),
         exact::to_double(term(2, 2))};
  for (std::size_t k = 0; k < 5; ++k) p.error[k] = std::abs(p.c[k]) * kRounded;
  return p;
}

int sign_in(const NearPolynomial& p, double low, double high) { return Bernstein(p, low, high).sign(); }

std::vector<NearRoot> near_roots(const NearPolynomial& p, double low, double high) {
  constexpr int kDepth = 24;
  constexpr double kNarrow = 0x1p-44;
  std::vector<NearRoot> roots;
  NearPolynomial rest = p;
  bool zero = false;
  // A root at zero that is known to be one.
  while (rest.degree > 0 && rest.c[0] == 0 && rest.error[0] == 0) {
    zero = true;
    rest.divide();
  }
  add_roots(rest, low, high, kDepth, roots);
  if (zero && low <= 0 && high >= 0) roots.push_back({0, 0});
  for (NearRoot& root : roots) root.known = root.high - root.low <= kNarrow;
  return roots;
}

PairForm PairForm::minus(double t, const PairForm& o) const {
  const DoublePair x{t, 0};
  return {a - x * o.a, b - x * o.b, g - x * o.g, (floor + std::abs(t) * o.floor) * exact::kOutwards};
}

NearPolynomial PairForm::polynomial() const {
  NearPolynomial p;
  p.degree = 2;
  const DoublePair two{2, 0}, c2 = a - two * b;
  p.c = {a.value(), 2 * g.value(), c2.value(), 0, 0};
  for (std::size_t k = 0; k < 3; ++k) p.error[k] = std::abs(p.c[k]) * 0x1p-51 + 4 * floor;
  return p;
}

// Coordinates in units in which the span is near 1.
NearAngle::NearAngle(const TurningForms& forms, int chart, double t)
    : forms_(forms), t_(t), theta_(RotationRange{chart, t, t}.theta(t)) {
  const DoublePair tt = base::exact_product(t, t), one{1, 0}, whole = one + tt;
  cos_ = (one - tt) / whole;
  sin_ = (DoublePair{2 * t, 0}) / whole;
  if (chart == 1) {
    cos_ = -cos_;
    sin_ = -sin_;
  }
  BigInteger most = 1;
  std::array<std::vector<TurningForms::Vec>, 2> from;
  for (std::uint32_t op = 0; op < 2; ++op)
    for (std::uint32_t v = 0; v < forms.size(op); ++v) {
      const TurningForms::Vec &p = forms.grid_point(op, v), &o = forms.grid_point(op, 0);
      from[op].push_back({p.x - o.x, p.y - o.y});
      most = std::max({most, BigInteger(abs(from[op].back().x)), BigInteger(abs(from[op].back().y))});
    }
  exact_ = (t == 0 || std::abs(t) == 1) && msb(most) < 61;
  if (exact_)
    for (std::uint32_t op = 0; op < 2; ++op)
      for (const TurningForms::Vec& p : from[op])
        exact_at_[op].push_back({exact::Int<62>::from_int64(static_cast<std::int64_t>(p.x)),
                                 exact::Int<62>::from_int64(static_cast<std::int64_t>(p.y))});
  const int shift = -static_cast<int>(msb(most)) - 1;
  span_ = 8;  // differences of at most 2 in each axis, of either operand
  for (std::uint32_t op = 0; op < 2; ++op) {
    for (const TurningForms::Vec& p : from[op]) at_[op].push_back({pair_of(p.x, shift), pair_of(p.y, shift)});
    for (std::uint32_t e = 0; e < forms.size(op); ++e) {
      const Vec &a = at_[op][e], &b = at_[op][forms.operand(op).next[e]];
      edge_[op].push_back({b.x - a.x, b.y - a.y});
      length_[op].push_back(std::abs(edge_[op].back().x.value()) + std::abs(edge_[op].back().y.value()));
    }
  }
}

// (t - t_) / (1 + t t_), of which only the difference may be small: each end errs by some roundings of itself.
std::array<double, 2> NearAngle::range(const RotationRange& range) const {
  const auto u = [&](double t) { return (t - t_) / (1 + t * t_); };
  const double low = u(range.t_low), high = u(range.t_high);
  return {low - 0x1p-48 * std::abs(low), high + 0x1p-48 * std::abs(high)};
}

PairForm NearAngle::around(DoublePair a, DoublePair b, DoublePair g, double floor) const {
  const DoublePair turned = b * cos_ + g * sin_;
  return {a + turned, turned, g * cos_ - b * sin_, floor};
}

// Edges err by 2^-104 in these units, and so do differences; products and sums by a dozen times 2^-100 of what they are
// at most.
PairForm NearAngle::side(const WalkSegment& s, Pair v) const {
  const Pair from = TurningForms::start(s);
  const Vec& d = edge_[s.side][s.edge];
  const Vec dq{at_[0][v.p].x - at_[0][from.p].x, at_[0][v.p].y - at_[0][from.p].y},
      dp{at_[1][v.q].x - at_[1][from.q].x, at_[1][v.q].y - at_[1][from.q].y};
  const double floor = 0x1p-95 * span_ * length1(s) + 0x1p-102 * span_;
  if (s.side == 0) return around(cross_of(d, dq), cross_of(d, dp), dot_of(d, dp), floor);
  return around(cross_of(d, dp), cross_of(d, dq), -dot_of(d, dq), floor);
}

// At quarter turns cosine and sine are 0, 1 and -1.
ExactQuadratic NearAngle::exactly_around(const exact::Int<128>& a, const exact::Int<128>& b,
                                         const exact::Int<128>& g) const {
  const double c = cos_.value(), s = sin_.value();
  const exact::Int<128> turned = c != 0 ? (c > 0 ? b : -b) : (s > 0 ? g : -g),
                        slope = c != 0 ? (c > 0 ? g : -g) : (s > 0 ? -b : b);
  return {{a + turned, slope + slope, a - turned}};
}

ExactQuadratic NearAngle::exact_side(const WalkSegment& s, Pair v) const {
  const Pair from = TurningForms::start(s);
  const auto minus = [](const ExactVec& p, const ExactVec& q) { return std::pair{p.x - q.x, p.y - q.y}; };
  const auto d = minus(exact_at_[s.side][forms_.operand(s.side).next[s.edge]], exact_at_[s.side][s.edge]),
             dq = minus(exact_at_[0][v.p], exact_at_[0][from.p]), dp = minus(exact_at_[1][v.q], exact_at_[1][from.q]);
  const auto cross = [&](const auto& w) { return d.first * w.second - d.second * w.first; };
  const auto dot = [&](const auto& w) { return d.first * w.first + d.second * w.second; };
  if (s.side == 0) return exactly_around(cross(dq), cross(dp), dot(dp));
  return exactly_around(cross(dp), cross(dq), -dot(dq));
}

ExactQuadratic NearAngle::exact_cross(std::uint32_t side, std::uint32_t edge, std::uint32_t other_side,
                                      std::uint32_t other) const {
  const auto vector = [&](std::uint32_t op, std::uint32_t e) {
    const ExactVec &p = exact_at_[op][e], &q = exact_at_[op][forms_.operand(op).next[e]];
    return std::pair{q.x - p.x, q.y - p.y};
  };
  const auto d = vector(side, edge), e = vector(other_side, other);
  const exact::Int<128> cross = d.first * e.second - d.second * e.first, dot = d.first * e.first + d.second * e.second,
                        zero = exact::Int<128>::from_int64(0);
  if (side == other_side) return exactly_around(cross, zero, zero);
  return exactly_around(zero, cross, side == 1 ? -dot : dot);
}

PairForm NearAngle::cross(std::uint32_t side, std::uint32_t edge, std::uint32_t other_side, std::uint32_t other) const {
  const Vec &d = edge_[side][edge], &e = edge_[other_side][other];
  const double l = length_[side][edge], m = length_[other_side][other], floor = 0x1p-95 * l * m + 0x1p-102 * (l + m);
  const DoublePair zero;
  if (side == other_side) return {cross_of(d, e), zero, zero, floor};
  if (side == 1) return around(zero, cross_of(d, e), -dot_of(d, e), floor);
  return around(zero, cross_of(d, e), dot_of(d, e), floor);
}

}  // namespace dymsum::planar
