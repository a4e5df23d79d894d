#include "cspace/events/crossing_orders.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

constexpr std::int64_t kLargest = std::int64_t{1} << 28;
constexpr std::int64_t kExact = std::int64_t{1} << 10;
constexpr std::array<Heading, 4> kHeadings{Heading{1, 0}, Heading{0, 1}, Heading{-1, 0}, Heading{0, -1}};

}  // namespace

bool QuarterTurn::representable(const TurningForms& forms) {
  for (std::uint32_t op = 0; op < 2; ++op)
    for (std::uint32_t v = 0; v < forms.size(op); ++v) {
      const auto& [x, y] = forms.grid_point(op, v);
      if (abs(x) >= kLargest || abs(y) >= kLargest) return false;
    }
  return true;
}

QuarterTurn::QuarterTurn(const TurningForms& forms, int quarter)
    : forms_(forms), heading_(kHeadings[static_cast<std::size_t>(quarter)]) {
  const auto c = static_cast<std::int64_t>(heading_.c), s = static_cast<std::int64_t>(heading_.s);
  for (std::uint32_t op = 0; op < 2; ++op)
    for (std::uint32_t v = 0; v < forms.size(op); ++v) {
      const auto x = static_cast<std::int64_t>(forms.grid_point(op, v).x),
                 y = static_cast<std::int64_t>(forms.grid_point(op, v).y);
      at_[op].push_back(op == 0 ? Vec{x, y} : Vec{c * x - s * y, s * x + c * y});
      exact_forms_ = exact_forms_ && std::abs(x) <= kExact && std::abs(y) <= kExact;
    }
}

QuarterTurn::Vec QuarterTurn::direction(const WalkSegment& s) const {
  const Vec &a = at_[s.side][s.edge], &b = at_[s.side][forms_.operand(s.side).next[s.edge]];
  return {b.x - a.x, b.y - a.y};
}

std::int64_t QuarterTurn::side(const WalkSegment& s, Pair v) const {
  const Vec d = direction(s), from = position(TurningForms::start(s)), to = position(v);
  return d.x * (to.y - from.y) - d.y * (to.x - from.x);
}

// The origin is at the start of a, as in TurningForms::concurrency.
bool QuarterTurn::concurrent(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const {
  const Vec d = direction(a), e = direction(b), f = direction(c);
  const std::int64_t ca = f.x * d.y - f.y * d.x, ab = d.x * e.y - d.y * e.x;
  return exact::i128{side(b, TurningForms::start(a))} * ca + exact::i128{side(c, TurningForms::start(a))} * ab == 0;
}

int QuarterTurn::sign_beside(const TrigForm2& f, double width) const {
  if (f.at(heading_) != 0) return 0;
  // At quarter turns cosines and sines, also of twice the angle, are 0, 1 and -1.
  const double c = heading_.c, s = heading_.s, c2 = c * c - s * s, s2 = 2 * c * s;
  const std::array<double, 4> derivative{f.slope(heading_), -(f.b * c + f.g * s) - 4 * (f.b2 * c2 + f.g2 * s2),
                                         f.b * s - f.g * c + 8 * (f.b2 * s2 - f.g2 * c2),
                                         f.b * c + f.g * s + 16 * (f.b2 * c2 + f.g2 * s2)};
  double factor = 4;  // 2^(m + 1)
  for (std::size_t m = 1; m <= derivative.size(); ++m, factor *= 2) {
    const double d = derivative[m - 1];
    if (d == 0) continue;
    const double next = std::abs(f.b) + std::abs(f.g) + factor * (std::abs(f.b2) + std::abs(f.g2));
    if (!(std::abs(d) > next * std::abs(width) / static_cast<double>(m + 1) * exact::kOutwards)) return 0;
    return (d > 0) == (width > 0 || m % 2 == 0) ? 1 : -1;
  }
  return 0;
}

bool QuarterTurn::aligned(std::uint32_t e, std::uint32_t f) const {
  const Vec d = direction({1, e, 0}), g = direction({0, f, 0});
  return d.x * g.y - d.y * g.x == 0 && d.x * g.x + d.y * g.y > 0;
}

// Crowded: more pairs of edges are aligned than there are edges. With each come a dozen events or more, where its
// segments meet others; a whole slice looks at some segments per edge.
CrowdedQuarters::CrowdedQuarters(const TurningForms& forms, const std::vector<Alignment>& alignments) {
  if (!QuarterTurn::representable(forms)) return;
  for (std::size_t k = 0; k < 4; ++k) {
    const double theta = (k == 3 ? 3 : static_cast<double>(k)) * std::numbers::pi / 2;
    const auto low = std::lower_bound(alignments.begin(), alignments.end(), theta - kAngleSlack,
                                      [](const Alignment& a, double t) { return a.theta < t; });
    auto high = low;
    while (high != alignments.end() && high->theta <= theta + kAngleSlack) ++high;
    const double per_edge = static_cast<double>(high - low) / (forms.size(0) + forms.size(1));
    if (per_edge <= 1) continue;
    const QuarterTurn turn(forms, static_cast<int>(k));
    const auto pair = std::find_if(low, high, [&](const Alignment& a) { return turn.aligned(a.e, a.f); });
    if (pair != high) quarters_[k].emplace(CrowdedQuarter{turn, *pair, per_edge});
  }
}

const CrowdedQuarter* CrowdedQuarters::at(int chart, double t) const {
  if (t != -1 && t != 0 && t != 1) return nullptr;
  const int number = t == 0 ? 2 * chart : t > 0 ? 2 * chart + 1 : 3 - 2 * chart;
  const std::optional<CrowdedQuarter>& quarter = quarters_[static_cast<std::size_t>(number)];
  return quarter ? &*quarter : nullptr;
}

// The position at which a line crosses a at the midpoint.
struct CrossingOrders::Position {
  LineCrossing* crossing;
  double at, error;
  int turn;  // the sign of a's direction x the line's
  bool before(const Position& o) const { return o.at - at - o.error - error > 0; }
};

void CrossingOrders::find(std::uint32_t i, std::vector<LineCrossing>& list) const {
  constexpr std::size_t kMany = 12;
  std::uint32_t orders = 0;
  for (std::size_t first = 0; first < list.size();) {
    std::size_t last = first + 1;
    for (double high = list[first].high; last < list.size() && list[last].low <= high; ++last)
      high = std::max(high, list[last].high);
    if (last - first >= kMany) find(w_.segments[i], std::span(list).subspan(first, last - first), orders);
    first = last;
  }
}

void CrossingOrders::find(const WalkSegment& a, std::span<LineCrossing> run, std::uint32_t& orders) const {
  std::vector<Position> positions;
  for (LineCrossing& c : run) {
    const WalkSegment& b = w_.segments[c.other];
    const TrigForm d = forms_.cross(a, b);
    const double rounding = kTurnedCross * forms_.length1(a) * forms_.length1(b), cross = d.at(w_.heading),
                 size = std::abs(cross) - rounding;
    const bool crosses =
        d.far_from_zero(w_.heading, w_.half, rounding) || ends_.exactly_at_end(d) || ends_.sign_beside(a, b) != 0;
    if (!crosses || !(size > 0)) continue;
    const double t = forms_.side(b, TurningForms::start(a)).at(w_.heading) / cross;
    positions.push_back({&c, t, (forms_.side_error(b) + std::abs(t) * rounding) / size * kWider, cross > 0 ? 1 : -1});
  }
  std::stable_sort(positions.begin(), positions.end(),
                   [](const Position& x, const Position& y) { return x.at < y.at; });
  sort_unclear(a, positions);
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k].crossing->order = k > 0 && keep_order(a, positions[k - 1], positions[k]) ? orders : ++orders;
}

// Positions that come together at a crowded quarter turn may be nearer to each other than doubles distinguish. A step
// or two sort most of them.
void CrossingOrders::sort_unclear(const WalkSegment& a, std::vector<Position>& positions) const {
  constexpr std::size_t kSteps = 8;
  for (std::size_t k = 1; k < positions.size(); ++k)
    for (std::size_t j = k; j > 0 && j + kSteps > k && !positions[j - 1].before(positions[j]) &&
                            order_beside_end(a, positions[j - 1], positions[j]) > 0;
         --j)
      std::swap(positions[j - 1], positions[j]);
}

// The sign of the first position less the second one's in all of the window but a crowded end, at which both are one; 0
// where that is not so.
int CrossingOrders::order_beside_end(const WalkSegment& a, const Position& x, const Position& y) const {
  const TrigForm2 g = forms_.concurrency(a, w_.segments[x.crossing->other], w_.segments[y.crossing->other]);
  for (const QuarterTurn* end : {ends_.low(), ends_.high()})
    if (end != nullptr && end->exact_forms())
      if (const int sign = end->sign_beside(g, end == ends_.low() ? ends_.width() : -ends_.width()))
        return sign * x.turn * y.turn;
  return ends_.sign_beside(a, w_.segments[x.crossing->other], w_.segments[y.crossing->other]) * x.turn * y.turn;
}

// Doubles prove it for every part of the window.
bool CrossingOrders::never_zero(const TrigForm2& g, double error) const {
  constexpr int kParts = 4;
  for (int k = 0; k < kParts; ++k)
    if (!g.far_from_zero(Heading::of(w_.midpoint + w_.half * (2 * k + 1 - kParts) / kParts), w_.half / kParts * kWider,
                         error))
      return false;
  return true;
}

// Whether two lines are one and the same, or the first one crosses a before the second one at all angles.
bool CrossingOrders::keep_order(const WalkSegment& a, const Position& x, const Position& y) const {
  const WalkSegment &b = w_.segments[x.crossing->other], &c = w_.segments[y.crossing->other];
  if (!x.before(y))
    return order_beside_end(a, x, y) < 0 ||
           (same_direction(forms_, b, c) && forms_.exact_side(b, TurningForms::start(c), w_.range.chart).is_zero());
  const TrigForm2 g = forms_.concurrency(a, b, c);
  const double error = forms_.concurrency_error(a, b, c);
  if (g.far_from_zero(w_.heading, w_.half, error)) return true;
  if (ends_.at_end(g, error, [&](const QuarterTurn& end) { return end.concurrent(a, b, c); })) return true;
  if (ends_.sign_beside(a, b, c) != 0) return true;
  const double first = g.at(Heading::of(w_.low)), last = g.at(Heading::of(w_.high));
  if (std::min(first, last) < -error && std::max(first, last) > error) return false;
  if (never_zero(g, error)) return true;
  const exact::Polynomial p = forms_.exact_concurrency(a, b, c, w_.range.chart);
  return !p.is_zero() && ends_.roots(p).empty();
}

}  // namespace dymsum::planar
