#include "planar/boolean/line_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "exact/near_values.h"

namespace dymsum::planar {

namespace {

using exact::BigRational;
using exact::exact_value;
using exact::Residue;

/// x in coordinates along two columns.
Point solved(const RingAxes& columns, Point x) {
  const double det = cross(columns[0], columns[1]);
  return {cross(x, columns[1]) / det, cross(columns[0], x) / det};
}

struct Midpoint {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  double value() const { return low / 2 + high / 2; }
};

/// The steps of along_axes.
class CoordinatesAlong {
 public:
  CoordinatesAlong(const LineSet& set, const std::vector<LineChain>& all, AlongAxes& result)
      : set_(set), all_(all), result_(result) {}

  void run() {
    const bool own = result_.axes == kOwnAxes;
    const double unit = set_.unit, width = set_.tolerance / (own && set_.rounded ? 32 : 2);
    const Point from = own ? Point{0, 0} : rounded_midpoint(unit);
    Point shift = from, center;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      std::vector<double> values = values_of(axis, from);
      Midpoint box;
      for (const double v : values) box.add(v);
      const double midpoint = box.value();
      (axis == 0 ? center.x : center.y) = own ? midpoint : 0;
      if (!own)
        for (double& v : values) v -= midpoint;
      result_.merged += exact::join_values(values, width, [&](const std::vector<double>& run) {
        return own ? exact::most_usual(run) : exact::midpoint_of(run, unit);
      });
      if (!own) shift = {shift.x + midpoint * result_.axes[axis].x, shift.y + midpoint * result_.axes[axis].y};
      put(axis, values);
    }
    const auto in_units = [&](double v) { return exact_value(own ? v : std::nearbyint(v / unit) * unit); };
    result_.shift = {in_units(shift.x), in_units(shift.y)};
    result_.center = result_.position(center);
  }

 private:
  Point rounded_midpoint(double unit) const {
    Midpoint x, y;
    for (const Point& p : set_.at) x.add(p.x), y.add(p.y);
    return {std::nearbyint(x.value() / unit) * unit, std::nearbyint(y.value() / unit) * unit};
  }
  std::vector<double> values_of(std::size_t axis, Point from) const {
    std::vector<double> values;
    for (const std::size_t c : result_.chains) {
      for (std::uint32_t k = 0; k < all_[c].count; ++k) {
        const Point& p = set_.at[all_[c].first + k];
        const Point along = result_.axes == kOwnAxes ? p : solved(result_.axes, p - from);
        values.push_back(axis == 0 ? along.x : along.y);
      }
    }
    return values;
  }
  void put(std::size_t axis, const std::vector<double>& values) {
    std::size_t next = 0;
    result_.at.resize(result_.chains.size());
    for (std::size_t c = 0; c < result_.chains.size(); ++c) {
      result_.at[c].resize(all_[result_.chains[c]].count);
      for (Point& p : result_.at[c]) (axis == 0 ? p.x : p.y) = values[next++];
    }
  }

  const LineSet& set_;
  const std::vector<LineChain>& all_;
  AlongAxes& result_;
};

/// A direction by the quotient of its components.
constexpr Residue kUpright = std::numeric_limits<Residue>::max();
std::optional<Residue> direction_of(Point a, Point b) {
  const Residue x = exact::minus(exact::residue_of(b.x), exact::residue_of(a.x)),
                y = exact::minus(exact::residue_of(b.y), exact::residue_of(a.y));
  if (x == 0) return y == 0 ? std::nullopt : std::optional(kUpright);
  return exact::times(y, exact::inverse(x));
}
Residue direction_across(Residue d) {
  if (d == kUpright) return 0;
  return d == 0 ? kUpright : exact::minus(0, exact::inverse(d));
}

void sort_and_unite(std::vector<Residue>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

struct ChainChoice {
  std::optional<RingAxes> found, chosen;
  std::map<std::size_t, std::vector<Residue>> good;  ///< candidates of the best rating, with their directions
};

/// The steps of choose_axes.
class LineAxesChoice {
 public:
  LineAxesChoice(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains, const LineFamilies& found)
      : sets_(sets), chains_(chains), found_(found), choices_(chains.size()) {}

  std::vector<RingAxes> run() {
    add_candidates();
    std::vector<ChainChoice*> open;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (!choices_[c].found) continue;
      rate(c);
      open.push_back(&choices_[c]);
    }
    while (!open.empty()) {
      const std::size_t best = best_for(open);
      for (ChainChoice* choice : open)
        if (choice->good.contains(best)) choice->chosen = candidates_[best];
      std::erase_if(open, [](const ChainChoice* choice) { return choice->chosen.has_value(); });
    }
    std::vector<RingAxes> axes;
    for (const ChainChoice& choice : choices_) axes.push_back(choice.chosen.value_or(kOwnAxes));
    return axes;
  }

 private:
  void add_candidates() {
    const auto numbers = [](const RingAxes& a) { return std::array{a[0].x, a[0].y, a[1].x, a[1].y}; };
    std::vector<RingAxes> found;
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if ((choices_[c].found = chain_axes(found_, sets_, chains_, c))) found.push_back(*choices_[c].found);
    std::sort(found.begin(), found.end(),
              [&](const RingAxes& a, const RingAxes& b) { return numbers(a) < numbers(b); });
    found.erase(std::unique(found.begin(), found.end()), found.end());
    candidates_ = {kOwnAxes};
    for (const RingAxes& axes : found)
      if (axes != kOwnAxes) candidates_.push_back(axes);
    for (std::size_t k = 1; k < candidates_.size(); ++k)
      for (const Point& d : candidates_[k]) along_[{d.x, d.y}].push_back(k);
  }

  bool has_few_digits(std::size_t chain) const {
    const LineSet& set = sets_[chains_[chain].set];
    const auto first = set.at.begin() + chains_[chain].first;
    return std::all_of(first, first + chains_[chain].count, [&](const Point& p) {
      return std::remainder(p.x, set.unit) == 0 && std::remainder(p.y, set.unit) == 0;
    });
  }
  /// Those along which some edge of the chain runs; the own axes also for coordinates of few digits. With all digits
  /// edges are parallel along them by chance alone, and lengths are not rounded.
  std::vector<std::size_t> candidates_of(std::size_t chain) const {
    std::vector<std::size_t> list;
    if (has_few_digits(chain)) list.push_back(0);
    for (const std::uint32_t f : found_.of_edge[chain]) {
      if (f == LineFamilies::kNone || !found_.families[f].meant) continue;
      const Point d = found_.families[f].direction;
      if (d.x == 0 || d.y == 0) list.push_back(0);
      if (const auto with = along_.find({d.x, d.y}); with != along_.end())
        list.insert(list.end(), with->second.begin(), with->second.end());
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  void rate(std::size_t chain) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    ChainChoice& choice = choices_[chain];
    for (const std::size_t k : candidates_of(chain)) {
      std::vector<Residue> directions = directions_along(chain, candidates_[k]);
      const std::size_t rating = directions.size() + directions_but_right_angles(directions, candidates_[k]);
      if (rating < fewest) choice.good.clear();
      fewest = std::min(fewest, rating);
      if (rating == fewest) choice.good.emplace(k, std::move(directions));
    }
  }
  std::vector<Residue> directions_along(std::size_t chain, const RingAxes& axes) const {
    const AlongAxes along = along_axes(sets_, chains_, {chain}, axes);
    const LineChain& c = chains_[chain];
    std::vector<Residue> directions;
    for (std::uint32_t e = 0; e < c.edges(); ++e)
      if (const auto d = direction_of(along.at[0][e], along.at[0][c.to(e) - c.first])) directions.push_back(*d);
    sort_and_unite(directions);
    return directions;
  }
  static std::size_t directions_but_right_angles(std::vector<Residue> directions, const RingAxes& axes) {
    if (axes[1] != quarter_turned(axes[0])) return directions.size();
    for (Residue& d : directions) d = std::min(d, direction_across(d));
    sort_and_unite(directions);
    return directions.size();
  }

  std::size_t best_for(const std::vector<ChainChoice*>& open) const {
    std::map<std::size_t, std::pair<std::size_t, std::vector<Residue>>> by_candidate;
    for (const ChainChoice* choice : open) {
      for (const auto& [k, directions] : choice->good) {
        auto& [chains, together] = by_candidate[k];
        ++chains;
        together.insert(together.end(), directions.begin(), directions.end());
      }
    }
    std::size_t best = 0, most = 0, fewest = 0;
    for (auto& [k, of] : by_candidate) {
      sort_and_unite(of.second);
      const std::size_t directions = of.second.size();
      if (of.first > most || (of.first == most && directions < fewest)) best = k, most = of.first, fewest = directions;
    }
    return best;
  }

  const std::vector<LineSet>& sets_;
  const std::vector<LineChain>& chains_;
  const LineFamilies& found_;
  std::vector<ChainChoice> choices_;
  std::vector<RingAxes> candidates_;
  std::map<std::pair<double, double>, std::vector<std::size_t>> along_;  ///< direction -> candidates with it
};

}  // namespace

Position AlongAxes::position(Point along) const {
  if (axes == kOwnAxes) return {exact_value(along.x), exact_value(along.y)};  // shift is 0
  const BigRational x = exact_value(along.x), y = exact_value(along.y);
  return {shift.x + x * exact_value(axes[0].x) + y * exact_value(axes[1].x),
          shift.y + x * exact_value(axes[0].y) + y * exact_value(axes[1].y)};
}

AlongAxes along_axes(const std::vector<LineSet>& sets, const std::vector<LineChain>& all,
                     std::vector<std::size_t> chains, const RingAxes& axes) {
  AlongAxes result;
  result.axes = axes;
  result.chains = std::move(chains);
  CoordinatesAlong(sets[all[result.chains[0]].set], all, result).run();
  return result;
}

std::vector<RingAxes> choose_axes(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains,
                                  const LineFamilies& found) {
  return LineAxesChoice(sets, chains, found).run();
}

}  // namespace dymsum::planar
