#include "shape/decompose/cut_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "exact/rounding_bound.h"

namespace dymsum::shape {
namespace {

struct Obstacle {
  RationalPoint a, b;
  double x0, y0, x1, y1;  ///< a box around it
  Cut::End kind;          ///< edge or cut
  std::uint32_t index;    ///< of the edge or cut
};

Rational cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
}
Rational dot(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return (b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y);
}

/// No more than the square of the distance of p from the obstacle: a difference, a square, a sum and the factor round
/// less than 2^12 times, and what underflows is less than kUnderflow.
double least_square(const Obstacle& o, Point p) {
  const double dx = std::max({0.0, o.x0 - p.x, p.x - o.x1}), dy = std::max({0.0, o.y0 - p.y, p.y - o.y1});
  return (dx * dx + dy * dy) * exact::kInwards - exact::kUnderflow;
}

/// No less than a number that is not negative.
double at_least(const Rational& v) { return std::nextafter(v.to_double(), INFINITY); }

struct Found {
  Rational square, t;
  RationalPoint at;
  const Obstacle* obstacle;
};

/// Directions that resolve the notch at m: not to the right of m -> next, not to the left of m -> previous.
struct Notch {
  RationalPoint m, previous, next;

  bool admits(const RationalPoint& p) const {
    return cross(m, next, m, p).sign() >= 0 && cross(m, previous, m, p).sign() <= 0;
  }
  /// The part of a segment in the cone: {first, last} in [0, 1], nothing where it does not meet it.
  std::optional<std::pair<Rational, Rational>> clip(const Obstacle& o) const {
    Rational first(0), last(1);
    const std::pair<Rational, Rational> sides[] = {{cross(m, next, m, o.a), cross(m, next, m, o.b)},
                                                   {-cross(m, previous, m, o.a), -cross(m, previous, m, o.b)}};
    for (const auto& [at_a, at_b] : sides) {
      if (at_a.sign() < 0 && at_b.sign() < 0) return std::nullopt;
      if (at_a.sign() < 0) first = std::max(first, at_a / (at_a - at_b));
      if (at_b.sign() < 0) last = std::min(last, at_a / (at_a - at_b));
    }
    if (last < first) return std::nullopt;
    return std::pair{first, last};
  }
  std::optional<Found> nearest(const Obstacle& o) const {
    const auto part = clip(o);
    if (!part) return std::nullopt;
    Rational t = dot(o.a, o.b, o.a, m) / dot(o.a, o.b, o.a, o.b);
    t = std::min(std::max(t, part->first), part->second);
    const RationalPoint at{o.a.x + t * (o.b.x - o.a.x), o.a.y + t * (o.b.y - o.a.y)};
    Rational square = dot(m, at, m, at);
    if (square.sign() == 0) return std::nullopt;  // it touches m itself
    return Found{std::move(square), std::move(t), at, &o};
  }
};

Obstacle obstacle(RationalPoint a, RationalPoint b, Cut::End kind, std::uint32_t index) {
  const double ax = a.x.to_double(), ay = a.y.to_double(), bx = b.x.to_double(), by = b.y.to_double();
  // The exact number lies between the neighbours of the double nearest to it.
  const auto below = [](double v) { return std::nextafter(v, -INFINITY); };
  const auto above = [](double v) { return std::nextafter(v, INFINITY); };
  return {std::move(a),
          std::move(b),
          below(std::min(ax, bx)),
          below(std::min(ay, by)),
          above(std::max(ax, bx)),
          above(std::max(ay, by)),
          kind,
          index};
}

class CutSearch {
 public:
  explicit CutSearch(const RingTable& table) : table_(table) {
    for (std::uint32_t v = 0; v < table.at.size(); ++v)
      edges_.push_back(
          obstacle(rational_point(table.at[v]), rational_point(table.at[table.next[v]]), Cut::End::edge, v));
  }

  std::vector<Cut> run(const std::vector<FeatureBar>& bars, const std::vector<std::uint32_t>& order) {
    const std::vector<std::uint32_t> leading = leading_bars(bars, order);
    std::vector<bool> done(table_.at.size(), false);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const FeatureBar& bar = bars[order[k]];
      if (!bar.minimum || done[*bar.minimum]) continue;
      done[*bar.minimum] = true;
      const auto stands = [&](std::uint32_t ring) {  // outer rings, and holes as significant as the bar
        if (!table_.is_hole[ring]) return true;
        if (leading[ring] == order.size()) return false;
        const FeatureBar& other = bars[order[leading[ring]]];
        return leading[ring] <= k ||
               (other.birth == bar.birth && other.death == bar.death && other.concavity == bar.concavity);
      };
      cut_at(*bar.minimum, order[k], stands);
    }
    return std::move(cuts_);
  }

 private:
  /// Ring -> place in the order of the longest bar of a hole's tracks.
  std::vector<std::uint32_t> leading_bars(const std::vector<FeatureBar>& bars,
                                          const std::vector<std::uint32_t>& order) const {
    std::vector<std::uint32_t> leading(table_.is_hole.size(), std::uint32_t(order.size()));
    for (std::size_t k = order.size(); k-- > 0;)
      if (bars[order[k]].minimum) leading[table_.ring[*bars[order[k]].minimum]] = std::uint32_t(k);
    return leading;
  }

  bool resolved(const Notch& notch) const {
    for (const Obstacle& cut : made_) {
      if (cross(cut.a, cut.b, cut.a, notch.m).sign() != 0) continue;
      const Rational along = dot(cut.a, cut.b, cut.a, notch.m);
      if (along.sign() < 0 || along > dot(cut.a, cut.b, cut.a, cut.b)) continue;
      if ((cut.a != notch.m && notch.admits(cut.a)) || (cut.b != notch.m && notch.admits(cut.b))) return true;
    }
    return false;
  }

  template <class Stands>
  void cut_at(std::uint32_t v, std::uint32_t bar, const Stands& stands) {
    const Notch notch{rational_point(table_.at[v]), rational_point(table_.at[table_.previous[v]]),
                      rational_point(table_.at[table_.next[v]])};
    if (resolved(notch)) return;
    std::vector<std::pair<double, const Obstacle*>> near;
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (e != v && table_.next[e] != v && stands(table_.ring[e]))
        near.emplace_back(least_square(edges_[e], table_.at[v]), &edges_[e]);
    for (const Obstacle& cut : made_) near.emplace_back(least_square(cut, table_.at[v]), &cut);
    // A heap gives the nearest boxes first; few are looked at.
    const auto farther = [](const auto& a, const auto& b) { return a.first > b.first; };
    std::make_heap(near.begin(), near.end(), farther);
    std::optional<Found> best;
    while (!near.empty()) {
      std::pop_heap(near.begin(), near.end(), farther);
      const auto [square, o] = near.back();
      near.pop_back();
      if (best && square > at_least(best->square)) break;
      std::optional<Found> found = notch.nearest(*o);
      if (found && (!best || found->square < best->square || (found->square == best->square && before(*found, *best))))
        best = std::move(found);
    }
    if (best) add(v, bar, notch.m, *best);
  }

  /// Of ends equally far: on the boundary before cuts, then by index.
  static bool before(const Found& a, const Found& b) {
    if (a.obstacle->kind != b.obstacle->kind) return a.obstacle->kind == Cut::End::edge;
    return a.obstacle->index < b.obstacle->index;
  }

  void add(std::uint32_t v, std::uint32_t bar, const RationalPoint& m, const Found& found) {
    Cut cut{v, found.obstacle->kind, found.obstacle->index, m, found.at, bar};
    if (cut.end == Cut::End::edge && (found.t == Rational(0) || found.t == Rational(1))) {
      cut.end = Cut::End::vertex;
      cut.index = found.t == Rational(0) ? cut.index : table_.next[cut.index];
    }
    made_.push_back(obstacle(cut.from, cut.to, Cut::End::cut, std::uint32_t(cuts_.size())));
    cuts_.push_back(std::move(cut));
  }

  const RingTable& table_;
  std::vector<Obstacle> edges_, made_;
  std::vector<Cut> cuts_;
};

}  // namespace

RationalPoint rational_point(Point p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

RingTable ring_table(const Region& region) {
  RingTable table;
  const auto add = [&](const Ring& ring, bool hole) {
    const auto first = std::uint32_t(table.at.size()), n = std::uint32_t(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      table.at.push_back(ring[i]);
      table.next.push_back(first + (i + 1) % n);
      table.previous.push_back(first + (i + n - 1) % n);
      table.ring.push_back(std::uint32_t(table.is_hole.size()));
    }
    table.is_hole.push_back(hole);
  };
  for (const Part& part : region.parts()) {
    add(part.outer, false);
    for (const Ring& hole : part.holes) add(hole, true);
  }
  return table;
}

std::vector<Cut> find_cuts(const RingTable& table, const std::vector<FeatureBar>& bars,
                           const std::vector<std::uint32_t>& order) {
  return CutSearch(table).run(bars, order);
}

}  // namespace dymsum::shape
