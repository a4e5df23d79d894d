#include "shape/decompose/wall_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "exact/orient.h"
#include "exact/rounding_bound.h"

namespace dymsum::shape {

RationalPoint rational_point(Point p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

bool RingTable::is_reflex(std::uint32_t v) const { return exact::orient_sign(at[previous[v]], at[v], at[next[v]]) < 0; }

std::vector<std::uint32_t> RingTable::ranked_rings() const {
  std::vector<std::uint32_t> rings(ring_count()), least;
  std::iota(rings.begin(), rings.end(), 0U);
  for (const std::uint32_t r : rings)
    least.push_back(*std::min_element(rank.begin() + first[r], rank.begin() + first[r + 1]));
  std::sort(rings.begin(), rings.end(), [&](std::uint32_t a, std::uint32_t b) { return least[a] < least[b]; });
  return rings;
}

namespace {

/// Vertices in an edge have no ranks: they come after all others, by those of its ends, then from the lesser end on.
void rank_straight_vertices(RingTable& table, const std::vector<std::optional<std::uint32_t>>& known) {
  using Key = std::array<std::uint32_t, 4>;
  const auto walk = [&](std::uint32_t v, const std::vector<std::uint32_t>& step) {
    std::uint32_t steps = 0;
    for (; !known[v]; v = step[v]) ++steps;
    return std::pair{*known[v], steps};
  };
  std::vector<std::pair<Key, std::uint32_t>> keys;
  for (std::uint32_t v = 0; v < table.at.size(); ++v) {
    const auto ahead = walk(v, table.next), behind = walk(v, table.previous);
    const auto [near, far] = std::minmax(ahead, behind);
    keys.push_back({known[v] ? Key{0, *known[v], 0, 0} : Key{1, near.first, far.first, near.second}, v});
  }
  std::sort(keys.begin(), keys.end());
  table.rank.resize(keys.size());
  for (std::uint32_t k = 0; k < keys.size(); ++k) table.rank[keys[k].second] = k;
}

}  // namespace

RingTable ring_table(const Region& region, const std::vector<std::optional<std::uint32_t>>& rank) {
  RingTable table;
  std::uint32_t part_index = 0;
  const auto add = [&](const Ring& ring, bool hole) {
    const auto first = std::uint32_t(table.at.size()), n = std::uint32_t(ring.size());
    table.first.push_back(first);
    for (std::uint32_t i = 0; i < n; ++i) {
      table.at.push_back(ring[i]);
      table.next.push_back(first + (i + 1) % n);
      table.previous.push_back(first + (i + n - 1) % n);
      table.ring.push_back(std::uint32_t(table.is_hole.size()));
    }
    table.part.push_back(part_index);
    table.is_hole.push_back(hole);
  };
  for (const Part& part : region.parts()) {
    add(part.outer, false);
    for (const Ring& hole : part.holes) add(hole, true);
    ++part_index;
  }
  table.first.push_back(std::uint32_t(table.at.size()));
  rank_straight_vertices(table, rank);
  return table;
}

namespace {

using exact::Interval;

double below(double v) { return std::nextafter(v, -INFINITY); }
double above(double v) { return std::nextafter(v, INFINITY); }

Rational wall_cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
}
Rational wall_dot(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return (b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y);
}

/// (b - a) x (p - a) for p in the intervals.
Interval wide_cross(Point a, Point b, const Interval& px, const Interval& py) {
  const Interval ax(a.x), ay(a.y);
  return (Interval(b.x) - ax) * (py - ay) - (Interval(b.y) - ay) * (px - ax);
}

Interval clamped(const Interval& t, const Interval& first, const Interval& last) {
  const auto clamp = [](double v, double low, double high) { return std::min(std::max(v, low), high); };
  return {clamp(t.low(), first.low(), last.low()), clamp(t.high(), first.high(), last.high())};
}

Interval larger(const Interval& a, const Interval& b) {
  return {std::max(a.low(), b.low()), std::max(a.high(), b.high())};
}
Interval smaller(const Interval& a, const Interval& b) {
  return {std::min(a.low(), b.low()), std::min(a.high(), b.high())};
}

/// A side of the cone: the signs of a wall's ends, not negative in the cone, and the formula of the same.
struct ConeSide {
  int at_a, at_b;
  Interval value_a, value_b;
};

}  // namespace

Interval bounds_of(const Rational& v) {
  const double nearest = v.to_double();
  return {below(nearest), above(nearest)};
}

// A difference, a square, a sum and the factor round less than 2^12 times, and what underflows is less than kUnderflow.
double least_square(const Box& box, Point p) {
  const double dx = std::max({0.0, box.x0 - p.x, p.x - box.x1}), dy = std::max({0.0, box.y0 - p.y, p.y - box.y1});
  return (dx * dx + dy * dy) * exact::kInwards - exact::kUnderflow;
}

RationalPoint Wall::from() const { return rational_point(a); }
RationalPoint Wall::end() const { return to ? *to : rational_point(b); }

Wall edge_wall(Point a, Point b, std::uint32_t index, std::uint32_t ring) {
  return {Cut::End::edge,
          index,
          ring,
          a,
          b,
          Interval(b.x),
          Interval(b.y),
          std::nullopt,
          {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)}};
}

Wall cut_wall(Point a, const RationalPoint& to, std::uint32_t index, std::uint32_t ring) {
  const Point b{to.x.to_double(), to.y.to_double()};
  return {Cut::End::cut,
          index,
          ring,
          a,
          b,
          bounds_of(to.x),
          bounds_of(to.y),
          to,
          {std::min(a.x, below(b.x)), std::min(a.y, below(b.y)), std::max(a.x, above(b.x)), std::max(a.y, above(b.y))}};
}

int side_of_end(Point a, Point b, const Wall& wall) {
  if (!wall.to) return exact::orient_sign(a, b, wall.b);
  if (const std::optional<int> sign = sign_of(wide_cross(a, b, wall.bx, wall.by))) return *sign;
  const RationalPoint from = rational_point(a);
  return wall_cross(from, rational_point(b), from, *wall.to).sign();
}

int side_of(const Wall& wall, Point p) {
  if (!wall.to) return exact::orient_sign(wall.a, wall.b, p);
  return -side_of_end(wall.a, p, wall);
}

bool Notch::admits(Point p) const {
  return exact::orient_sign(m, next, p) >= 0 && exact::orient_sign(m, previous, p) <= 0;
}

bool Notch::admits_end(const Wall& wall) const {
  return side_of_end(m, next, wall) >= 0 && side_of_end(m, previous, wall) <= 0;
}

bool Notch::misses(const Box& box) const {
  const Point corners[] = {{box.x0, box.y0}, {box.x1, box.y0}, {box.x0, box.y1}, {box.x1, box.y1}};
  const auto all = [&](Point side, int sign) {
    return std::all_of(std::begin(corners), std::end(corners),
                       [&](Point c) { return exact::proved_cross_sign(m, side, m, c) == sign; });
  };
  return all(next, -1) || all(previous, 1);
}

Notch::Estimate Notch::estimate(const Wall& w) const {
  const ConeSide sides[] = {
      {exact::orient_sign(m, next, w.a), side_of_end(m, next, w), wide_cross(m, next, Interval(w.a.x), Interval(w.a.y)),
       wide_cross(m, next, w.bx, w.by)},
      {-exact::orient_sign(m, previous, w.a), -side_of_end(m, previous, w),
       -wide_cross(m, previous, Interval(w.a.x), Interval(w.a.y)), -wide_cross(m, previous, w.bx, w.by)}};
  Interval first(0), last(1);
  for (const ConeSide& side : sides) {
    if (side.at_a < 0 && side.at_b < 0) return {true, false, {}};
    if (side.at_a >= 0 && side.at_b >= 0) continue;
    const Interval meets = side.value_a / (side.value_a - side.value_b);
    (side.at_a < 0 ? first : last) = side.at_a < 0 ? larger(first, meets) : smaller(last, meets);
  }
  if (last.high() < first.low()) return {true, false, {}};
  const Interval mx(m.x), my(m.y), ax(w.a.x), ay(w.a.y), ux = w.bx - ax, uy = w.by - ay;
  const Interval length = square(ux) + square(uy), foot = (ux * (mx - ax) + uy * (my - ay)) / length;
  const Interval t = clamped(foot, first, last);
  const Interval dx = ax - mx + t * ux, dy = ay - my + t * uy;
  Interval result = square(dx) + square(dy);
  // Inside the part the formula of the height loses less than that of the point.
  if (first.high() < foot.low() && foot.high() < last.low()) result = square(ux * dy - uy * dx) / length;
  return {false, first.high() <= last.low() && result.low() > 0, result};
}

std::optional<Nearest> Notch::nearest(const Wall& w) const {
  const RationalPoint at = rational_point(m), a = w.from(), b = w.end(), n = rational_point(next),
                      p = rational_point(previous);
  Rational first(0), last(1);
  const std::pair<Rational, Rational> sides[] = {{wall_cross(at, n, at, a), wall_cross(at, n, at, b)},
                                                 {-wall_cross(at, p, at, a), -wall_cross(at, p, at, b)}};
  for (const auto& [at_a, at_b] : sides) {
    if (at_a.sign() < 0 && at_b.sign() < 0) return std::nullopt;
    if (at_a.sign() < 0) first = std::max(first, at_a / (at_a - at_b));
    if (at_b.sign() < 0) last = std::min(last, at_a / (at_a - at_b));
  }
  if (last < first) return std::nullopt;
  Rational t = wall_dot(a, b, a, at) / wall_dot(a, b, a, b);
  t = std::min(std::max(t, first), last);
  const RationalPoint found{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  Rational square = wall_dot(at, found, at, found);
  if (square.sign() == 0) return std::nullopt;  // it touches m itself
  return Nearest{std::move(square), std::move(t), found};
}

WallTree::WallTree(const std::vector<Wall>& walls, std::vector<std::uint32_t> of) : of_(std::move(of)) {
  build(walls, 0, std::uint32_t(of_.size()));
}

void WallTree::build(const std::vector<Wall>& walls, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  Box box = walls[of_[first]].box;
  for (std::uint32_t k = first + 1; k < last; ++k) box.add(walls[of_[k]].box);
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, first, last, 0});
  if (last - first <= kLeaf) return;
  const bool wide = box.x1 / 2 - box.x0 / 2 >= box.y1 / 2 - box.y0 / 2;
  const auto midpoint_of = [&](std::uint32_t w) {
    const Box& b = walls[w].box;
    return wide ? b.x0 / 2 + b.x1 / 2 : b.y0 / 2 + b.y1 / 2;
  };
  const std::uint32_t midpoint = first + (last - first) / 2;
  std::nth_element(of_.begin() + first, of_.begin() + midpoint, of_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const auto x = midpoint_of(a), y = midpoint_of(b);
                     return x != y ? x < y : a < b;
                   });
  build(walls, first, midpoint);
  nodes_[self].right = std::uint32_t(nodes_.size());
  build(walls, midpoint, last);
}

WallSet::WallSet(std::vector<Wall> edges) : walls_(std::move(edges)), loose_(std::uint32_t(walls_.size())) {
  std::vector<std::uint32_t> all(walls_.size());
  std::iota(all.begin(), all.end(), 0u);
  trees_.emplace_back(walls_, std::move(all));
}

void WallSet::add(Wall cut) {
  constexpr std::size_t kLoose = 16;
  walls_.push_back(std::move(cut));
  if (walls_.size() - loose_ < kLoose) return;
  std::vector<std::uint32_t> of(walls_.size() - loose_);
  std::iota(of.begin(), of.end(), loose_);
  loose_ = std::uint32_t(walls_.size());
  while (trees_.size() > 1 && trees_.back().of().size() <= of.size()) {
    of.insert(of.end(), trees_.back().of().begin(), trees_.back().of().end());
    trees_.pop_back();
  }
  trees_.emplace_back(walls_, std::move(of));
}

}  // namespace dymsum::shape
