#include "planar/boolean/line_families.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "exact/near_values.h"

namespace dymsum::planar {

namespace {

double length(Point d) { return std::sqrt(d.x * d.x + d.y * d.y); }  // correctly rounded everywhere, as hypot is not
Point upper(Point d) { return d.y < 0 || (d.y == 0 && d.x < 0) ? Point{-d.x, -d.y} : d; }

/// Directions in order, from 0 along the x axis to 2 at its opposite; an angle is at most twice the difference.
/// Requires the upper half plane.
double key_of(Point d) { return d.x >= 0 ? d.y / (d.x + d.y) : 1 - d.x / (d.y - d.x); }

/// Directions by their keys, where the last ones are next to the first ones.
class DirectionIndex {
 public:
  void add(Point direction, std::uint32_t family) { by_key_.emplace(key_of(direction), family); }
  /// Calls visit(family) for all within an angle, and some others.
  template <class Visit>
  void near(Point direction, double angle, Visit visit) const {
    const double key = key_of(direction), within = 1.01 * angle;  // of an angle below 1/32 by its sine
    for (const double around : {-2.0, 0.0, 2.0}) {
      const auto last = by_key_.upper_bound(key + around + within);
      for (auto it = by_key_.lower_bound(key + around - within); it != last; ++it) visit(it->second);
    }
  }

 private:
  std::multimap<double, std::uint32_t> by_key_;
};

struct SeenEdge {
  std::size_t chain = 0;
  std::uint32_t edge = 0;
  Point vector;  ///< in the upper half plane
  double length = 0, tilt = 0;
};

/// The steps of line_families.
class FamilyFinder {
 public:
  FamilyFinder(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains) : sets_(sets), chains_(chains) {}

  LineFamilies run() {
    collect();
    for (const SeenEdge& edge : edges_) join(edge);
    fix_directions();
    return std::move(found_);
  }

 private:
  /// Edges that say something about a direction, the longest first. Of many edges short ones would be parallel to
  /// others by chance.
  void collect() {
    std::size_t all = 0;
    for (const LineChain& chain : chains_) all += chain.edges();
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      const LineChain& chain = chains_[c];
      const LineSet& set = sets_[chain.set];
      found_.of_edge.emplace_back(chain.edges(), LineFamilies::kNone);
      for (std::uint32_t e = 0; e < chain.edges(); ++e) {
        const Point vector = upper(set.at[chain.to(e)] - set.at[chain.from(e)]);
        const double long_by = length(vector), tilt = set.tolerance / (2 * long_by);
        if (tilt <= 1.0 / 64 && tilt * static_cast<double>(all) <= 1) edges_.push_back({c, e, vector, long_by, tilt});
      }
    }
    const auto before = [](const SeenEdge& a, const SeenEdge& b) {
      if (a.length != b.length) return a.length > b.length;
      return a.vector.x != b.vector.x ? a.vector.x < b.vector.x : a.vector.y < b.vector.y;
    };
    std::stable_sort(edges_.begin(), edges_.end(), before);
  }

  void join(const SeenEdge& edge) {
    std::uint32_t best = LineFamilies::kNone;
    double least = edge.tilt;
    seeds_.near(edge.vector, edge.tilt, [&](std::uint32_t f) {
      const double sine = std::abs(cross(seed_[f], edge.vector)) / edge.length;
      if (sine <= least) best = f, least = sine;
    });
    if (best == LineFamilies::kNone) {
      best = static_cast<std::uint32_t>(seed_.size());
      seed_.push_back({edge.vector.x / edge.length, edge.vector.y / edge.length});
      seeds_.add(seed_.back(), best);
      found_.families.emplace_back();
      tilt_.push_back(edge.tilt);
      ratio_.push_back(1);
    }
    LineFamily& family = found_.families[best];
    const bool along = dot(seed_[best], edge.vector) >= 0;  // across the x axis it is not
    family.direction.x += along ? edge.vector.x : -edge.vector.x;
    family.direction.y += along ? edge.vector.y : -edge.vector.y;
    family.length += edge.length;
    ++family.edges;
    const LineSet& set = sets_[chains_[edge.chain].set];
    ratio_[best] = std::min(ratio_[best], set.tolerance / set.radius);
    found_.of_edge[edge.chain][edge.edge] = best;
  }

  /// Directions in few digits, from the longest family on.
  void fix_directions() {
    std::vector<std::uint32_t> order(seed_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return found_.families[a].length > found_.families[b].length;
    });
    DirectionIndex fixed;
    for (const std::uint32_t f : order) {
      LineFamily& family = found_.families[f];
      const double size = length(family.direction);
      const Point d = upper({family.direction.x / size, family.direction.y / size});
      std::uint32_t& across = family.across;
      if (std::abs(d.y) <= tilt_[f]) family.direction = {1, 0};
      else if (std::abs(d.x) <= tilt_[f]) family.direction = {0, 1};
      else if (across = family_across(d, f, fixed); across != LineFamilies::kNone)
        family.direction = upper(quarter_turned(found_.families[across].direction));
      else family.direction = in_few_digits(d, f);
      fixed.add(family.direction, f);
      family.meant =
          family.edges > 1 || across != LineFamilies::kNone || family.direction.x == 0 || family.direction.y == 0;
      if (across != LineFamilies::kNone) found_.families[across].meant = true;
    }
  }
  /// The nearest of the fixed families at a right angle.
  std::uint32_t family_across(Point d, std::uint32_t f, const DirectionIndex& fixed) const {
    std::uint32_t across = LineFamilies::kNone;
    double least = 2;
    fixed.near(upper(quarter_turned(d)), 1.0 / 32, [&](std::uint32_t g) {  // no tilt is larger than 1/64
      const double cosine = std::abs(dot(found_.families[g].direction, d));
      if (cosine <= tilt_[f] + tilt_[g] && cosine < least) across = g, least = cosine;
    });
    return across;
  }
  Point in_few_digits(Point d, std::uint32_t f) const {
    const double unit = std::max(exact::power_below(ratio_[f] / 32), 0x1p-52);
    return {std::nearbyint(d.x / unit) * unit, std::nearbyint(d.y / unit) * unit};
  }

  const std::vector<LineSet>& sets_;
  const std::vector<LineChain>& chains_;
  std::vector<SeenEdge> edges_;
  DirectionIndex seeds_;
  std::vector<Point> seed_;           ///< of families: their longest edges, of length 1
  std::vector<double> tilt_, ratio_;  ///< of families: of the longest edge; the least tolerance over a radius
  LineFamilies found_;
};

}  // namespace

LineFamilies line_families(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains) {
  return FamilyFinder(sets, chains).run();
}

RingAxes axes_of(Point a, Point b) { return cross(a, b) > 0 ? RingAxes{a, b} : RingAxes{b, a}; }

std::optional<RingAxes> chain_axes(const LineFamilies& found, const std::vector<LineSet>& sets,
                                   const std::vector<LineChain>& chains, std::size_t chain) {
  const LineChain& c = chains[chain];
  const std::vector<Point>& at = sets[c.set].at;
  std::map<std::uint32_t, double> length_of;
  for (std::uint32_t e = 0; e < c.edges(); ++e)
    if (const std::uint32_t f = found.of_edge[chain][e]; f != LineFamilies::kNone && found.families[f].meant)
      length_of[f] += length(at[c.to(e)] - at[c.from(e)]);
  if (length_of.empty()) return std::nullopt;
  std::vector<std::pair<double, std::uint32_t>> longest;
  for (const auto& [f, by] : length_of) longest.emplace_back(-by, f);
  std::sort(longest.begin(), longest.end());
  const auto direction = [&](const std::pair<double, std::uint32_t>& one) {
    return found.families[one.second].direction;
  };
  for (std::size_t k = 0; k < longest.size(); ++k) {
    const Point across = upper(quarter_turned(direction(longest[k])));
    for (std::size_t j = k + 1; j < longest.size(); ++j)
      if (direction(longest[j]) == across) return axes_of(direction(longest[k]), across);
  }
  constexpr double kFlat = 0.1;
  const Point first = direction(longest[0]);
  for (const auto& one : longest)
    if (std::abs(cross(first, direction(one))) > kFlat) return axes_of(first, direction(one));
  return axes_of(first, upper(quarter_turned(first)));
}

}  // namespace dymsum::planar
