#include "cspace/events/crossing_orders.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

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
