// Regions by their lines: docs/design/region-by-lines.md.
#include "dymsum/region_by_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "exact/near_values.h"
#include "planar/boolean/edges_on_lines.h"
#include "planar/boolean/line_axes.h"
#include "planar/boolean/line_families.h"
#include "planar/boolean/planar_boolean.h"

namespace dymsum {

namespace {

using exact::BigRational;
using planar::AlongAxes;
using planar::LineChain;
using planar::LineSet;
using planar::PlacedOnLines;
using planar::Position;

/// A ring or a polyline without vertices that repeat the one before.
struct GivenChain {
  std::vector<Point> vertices;
  bool closed = true, ring = true;
};

/// One region as chains in moderate units.
struct GivenRegion {
  std::vector<GivenChain> chains;
  std::vector<Point> points;
  int exponent = 0;  ///< coordinates are in units of 2^exponent
  exact::MoveTolerance tolerance;
  LineSet set;  ///< the vertices of all chains, then the points
};

std::optional<Error> fault_of(const RegionData& data) {
  const auto check = [](const std::vector<Point>& list) -> std::optional<Error> {
    for (const Point& p : list) {
      if (std::isfinite(p.x) && std::isfinite(p.y)) continue;
      Error error{ErrorCode::not_finite, "a coordinate is not finite", {}};
      error.evidence.x = p.x, error.evidence.y = p.y;
      return error;
    }
    return std::nullopt;
  };
  for (const Part& part : data.parts) {
    if (auto error = check(part.outer)) return error;
    for (const Ring& hole : part.holes)
      if (auto error = check(hole)) return error;
  }
  const Result<Region> thin = Region::create({{}, data.polylines, data.points});
  return thin ? std::nullopt : std::optional(thin.error());
}

void add_ring(const Ring& ring, std::vector<GivenChain>& chains) {
  GivenChain chain;
  for (const Point& p : ring)
    if (chain.vertices.empty() || chain.vertices.back() != p) chain.vertices.push_back(p);
  while (chain.vertices.size() > 1 && chain.vertices.back() == chain.vertices.front()) chain.vertices.pop_back();
  if (chain.vertices.size() >= 3) chains.push_back(std::move(chain));
}

GivenRegion given_region(const RegionData& data, const std::optional<double>& wanted) {
  GivenRegion given;
  for (const Part& part : data.parts) {
    add_ring(part.outer, given.chains);
    for (const Ring& hole : part.holes) add_ring(hole, given.chains);
  }
  for (const Polyline& line : data.polylines) {
    GivenChain chain{line, line.front() == line.back(), false};
    if (chain.closed) chain.vertices.pop_back();
    given.chains.push_back(std::move(chain));
  }
  given.points = data.points;
  for (const GivenChain& chain : given.chains)
    given.set.at.insert(given.set.at.end(), chain.vertices.begin(), chain.vertices.end());
  given.set.at.insert(given.set.at.end(), data.points.begin(), data.points.end());
  double largest = 0;
  for (const Point& p : given.set.at) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  constexpr int kPlain = 100;
  if (largest > 0 && std::abs(std::ilogb(largest)) > kPlain) given.exponent = std::ilogb(largest);
  std::vector<double> coordinates;
  std::array<double, 2> low{}, high{};
  for (std::size_t k = 0; k < given.set.at.size(); ++k) {
    Point& p = given.set.at[k];
    p = {std::ldexp(p.x, -given.exponent), std::ldexp(p.y, -given.exponent)};
    coordinates.insert(coordinates.end(), {p.x, p.y});
    low = k == 0 ? std::array{p.x, p.y} : std::array{std::min(low[0], p.x), std::min(low[1], p.y)};
    high = k == 0 ? std::array{p.x, p.y} : std::array{std::max(high[0], p.x), std::max(high[1], p.y)};
  }
  const double width = high[0] - low[0], height = high[1] - low[1];
  given.tolerance = exact::move_tolerance(coordinates, std::max(width, height),
                                          wanted ? std::optional(std::ldexp(*wanted, -given.exponent)) : std::nullopt,
                                          given.exponent == 0);
  given.set.radius = std::hypot(width, height) / 2;
  given.set.tolerance = given.tolerance.value, given.set.rounded = given.tolerance.rounded;
  return given;
}

/// Makes regions of their chains.
class LinesMaker {
 public:
  LinesMaker(std::vector<GivenRegion> given, const LinesOptions& options)
      : given_(std::move(given)), options_(options) {
    for (std::size_t s = 0; s < given_.size(); ++s) {
      std::uint32_t first = 0;
      for (const GivenChain& chain : given_[s].chains) {
        chains_.push_back({s, first, static_cast<std::uint32_t>(chain.vertices.size()), chain.closed});
        first += chains_.back().count;
      }
      sets_.push_back(given_[s].set);
    }
    choose_units();
  }

  Result<std::vector<RegionByLines>> run() {
    const planar::LineFamilies found = planar::line_families(sets_, chains_);
    const std::vector<RingAxes> axes = planar::choose_axes(sets_, chains_, found);
    make_groups(axes);
    std::vector<PlacedOnLines> placed = planar::edges_on_lines(sets_, chains_, found, groups_);
    std::vector<RegionByLines> made;
    for (std::size_t s = 0; s < given_.size(); ++s) {
      Result<RegionByLines> region = region_of(s, placed[s]);
      if (!region) return region.error();
      made.push_back(*std::move(region));
    }
    return made;
  }

 private:
  /// One for all regions, so that lengths that were equal are so: the one that the least tolerance wants, or the
  /// largest coordinates of all. A region for whose tolerance that is too large has one of its own.
  void choose_units() {
    double fine = std::numeric_limits<double>::infinity(), coarse = 0;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (!(sets_[s].tolerance > 0)) continue;
      fine = std::min(fine, std::ldexp(sets_[s].tolerance, given_[s].exponent));
      coarse = std::max(coarse, std::ldexp(given_[s].tolerance.least, given_[s].exponent));
    }
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (!(sets_[s].tolerance > 0)) continue;
      const double own = std::max(std::ldexp(fine, -given_[s].exponent), given_[s].tolerance.least);
      const double all = exact::power_below(std::ldexp(std::max(fine, coarse), -given_[s].exponent) / 16);
      sets_[s].unit = all <= sets_[s].tolerance / 4 ? all : exact::power_below(own / 16);
    }
  }
  /// Chains of a region along equal axes have their midpoint in common.
  void make_groups(const std::vector<RingAxes>& axes) {
    std::vector<bool> taken(chains_.size());
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (taken[c]) continue;
      std::vector<std::size_t> group;
      for (std::size_t d = c; d < chains_.size() && chains_[d].set == chains_[c].set; ++d) {
        if (axes[d] != axes[c]) continue;
        taken[d] = true;
        group.push_back(d);
      }
      groups_.push_back(planar::along_axes(sets_, chains_, std::move(group), axes[c]));
    }
  }

  Result<RegionByLines> region_of(std::size_t s, const PlacedOnLines& placed) const {
    const GivenRegion& given = given_[s];
    RegionByLines made;
    made.tolerance = std::ldexp(given.tolerance.value, given.exponent);
    made.merged = placed.merged, made.loose_edges = placed.loose_edges;
    for (const AlongAxes& group : groups_) {
      if (chains_[group.chains[0]].set != s) continue;
      made.merged += group.merged;
      if (group.axes != planar::kOwnAxes) made.axes.push_back(group.axes);
    }
    for (const LineChain& chain : chains_) made.edges += chain.set == s ? chain.edges() : 0;
    for (std::size_t v = 0; v < placed.at.size(); ++v)
      made.largest_move = std::max(made.largest_move,
                                   std::ldexp(planar::distance_above(placed.at[v], given.set.at[v]), given.exponent));
    planar::BooleanTerms terms{{std::make_shared<const planar::RingSet>(ring_set(given, placed))}, {0}};
    Result<PlanarSum> region = planar::evaluate(std::move(terms), options_.sums);
    if (!region) return region.error();
    made.region = *std::move(region);
    const bool nothing = made.region.parts.empty() && made.region.segments.empty() && made.region.points.empty();
    if (nothing && !given.set.at.empty()) return nothing_left(made.tolerance);
    return made;
  }
  static planar::RingSet ring_set(const GivenRegion& given, const PlacedOnLines& placed) {
    planar::RingSet set;
    bool doubles = true;
    std::size_t next = 0;
    const auto add = [&](std::vector<Point>& to) {
      Position at = placed.at[next++];
      if (given.exponent != 0) {
        const exact::BigInteger power = exact::BigInteger(1) << std::abs(given.exponent);
        for (BigRational* c : {&at.x, &at.y}) given.exponent > 0 ? * c *= power : * c /= power;
      }
      to.push_back({exact::round_to_double(at.x), exact::round_to_double(at.y)});
      set.fractions.push_back(planar::homogeneous(at));
      doubles = doubles && exact::exact_value(to.back().x) == at.x && exact::exact_value(to.back().y) == at.y;
    };
    for (const GivenChain& chain : given.chains) {  // rings come before lines
      std::vector<Point>& to = chain.ring ? set.rings.emplace_back() : set.lines.emplace_back();
      for (std::size_t k = 0; k < chain.vertices.size(); ++k) add(to);
      if (chain.ring || !chain.closed) continue;
      to.push_back(to.front());
      set.fractions.push_back(set.fractions[set.fractions.size() - chain.vertices.size()]);
    }
    for (std::size_t k = 0; k < given.points.size(); ++k) add(set.points);
    if (doubles) set.fractions.clear();
    return set;
  }
  static Error nothing_left(double tolerance) {
    char text[96];
    std::snprintf(text, sizeof text, "nothing is left of the region: it is thinner than the tolerance, %.3g",
                  tolerance);
    return {ErrorCode::no_area, text, {}};
  }

  std::vector<GivenRegion> given_;
  const LinesOptions& options_;
  std::vector<LineSet> sets_;
  std::vector<LineChain> chains_;
  std::vector<AlongAxes> groups_;
};

Error no_line_tolerance(double wanted, double least) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "a tolerance of %.3g moves no vertex to its lines: it must be at least %.3g, 64 units in the last place "
      "of the largest coordinate",
      wanted, least);
  return {ErrorCode::out_of_range, text, {}};
}

}  // namespace

std::string RegionByLines::to_string() const {
  char moved[96];
  std::snprintf(moved, sizeof moved, "; no vertex moved by more than %.2g (allowed: %.2g)", largest_move, tolerance);
  const auto counted = [](std::size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
  };
  return counted(edges, "edge") + " became " + std::to_string(region.vertex_count() + region.segments.size()) +
         (axes.empty() ? "" : ", along axes of " + (axes.size() == 1 ? "their own" : counted(axes.size(), "ring"))) +
         (loose_edges == 0 ? "" : "; " + counted(loose_edges, "edge") + " nearly parallel to others left so") + moved;
}

Result<std::vector<RegionByLines>> by_lines(std::span<const RegionData> regions, const LinesOptions& options) {
  std::vector<GivenRegion> given;
  for (const RegionData& data : regions) {
    if (auto error = fault_of(data)) return *std::move(error);
    given.push_back(given_region(data, options.tolerance));
    const exact::MoveTolerance& tolerance = given.back().tolerance;
    if (given.back().set.at.empty() || (tolerance.value >= tolerance.least && std::isfinite(tolerance.value) &&
                                        (tolerance.value > 0 || !options.tolerance)))
      continue;
    return no_line_tolerance(options.tolerance.value_or(0), std::ldexp(tolerance.least, given.back().exponent));
  }
  return LinesMaker(std::move(given), options).run();
}

Result<RegionByLines> by_lines(const RegionData& data, const LinesOptions& options) {
  Result<std::vector<RegionByLines>> made = by_lines(std::span(&data, 1), options);
  if (!made) return made.error();
  return std::move(std::move(made).value()[0]);
}

}  // namespace dymsum
