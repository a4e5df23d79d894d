#include "planar/boolean/edges_on_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "exact/near_values.h"

namespace dymsum::planar {

namespace {

using exact::BigInteger;
using exact::BigRational;
using exact::exact_value;

BigRational exact_cross(const Position& a, const Position& b) { return a.x * b.y - a.y * b.x; }
Position exact_difference(const Position& a, const Position& b) { return {a.x - b.x, a.y - b.y}; }
Position exact_point(Point p) { return {exact_value(p.x), exact_value(p.y)}; }

/// The same direction in integers without a common divisor.
Position primitive(const Position& d) {
  const BigInteger unit = lcm(denominator(d.x), denominator(d.y));
  const BigInteger x = numerator(d.x) * (unit / denominator(d.x)), y = numerator(d.y) * (unit / denominator(d.y));
  const BigInteger common = gcd(x, y);
  return {BigRational(BigInteger(x / common)), BigRational(BigInteger(y / common))};
}

/// An edge of a family, by chain and index.
struct FamilyEdge {
  std::size_t chain = 0;
  std::uint32_t edge = 0;
};

struct ExactLine {
  std::uint32_t family = 0;
  BigRational height;  ///< direction x position
};

/// The steps of edges_on_lines.
class LinePlacement {
 public:
  LinePlacement(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains, const LineFamilies& found,
                const std::vector<AlongAxes>& groups)
      : sets_(sets), chains_(chains), found_(found), groups_(groups), result_(sets.size()) {}

  std::vector<PlacedOnLines> run() {
    put_along_axes();
    sort_edges();
    find_directions();
    for (const auto& [family, by_group] : edges_)
      for (const auto& [group, edges] : by_group) add_lines(family, group, edges);
    for (std::size_t c = 0; c < chains_.size(); ++c) move_vertices(c);
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kNone = LineFamilies::kNone;

  void put_along_axes() {
    for (std::size_t s = 0; s < sets_.size(); ++s)
      for (const Point& p : sets_[s].at) result_[s].at.push_back(exact_point(p));
    group_of_.resize(chains_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (std::size_t k = 0; k < groups_[g].chains.size(); ++k) {
        const LineChain& chain = chains_[groups_[g].chains[k]];
        group_of_[groups_[g].chains[k]] = g;
        for (std::uint32_t v = 0; v < chain.count; ++v)
          result_[chain.set].at[chain.first + v] = groups_[g].position(groups_[g].at[k][v]);
      }
    }
    along_axes_ = result_;
  }

  Position vector(const FamilyEdge& e) const {
    const LineChain& chain = chains_[e.chain];
    const std::vector<Position>& at = along_axes_[chain.set].at;
    return exact_difference(at[chain.to(e.edge)], at[chain.from(e.edge)]);
  }
  double length_of(const FamilyEdge& e) const {
    const LineChain& chain = chains_[e.chain];
    const std::vector<Point>& at = sets_[chain.set].at;
    const Point d = at[chain.to(e.edge)] - at[chain.from(e.edge)];
    return std::hypot(d.x, d.y);
  }

  /// Edges along an axis of their group lie on lines already, those of other meant families are to be put on some.
  void sort_edges() {
    line_of_.resize(chains_.size());
    axis_of_.resize(chains_.size());
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      line_of_[c].assign(chains_[c].edges(), kNone);
      axis_of_[c].assign(chains_[c].edges(), kNone);
      const RingAxes& axes = groups_[group_of_[c]].axes;
      for (std::uint32_t e = 0; e < chains_[c].edges(); ++e) {
        const std::uint32_t f = found_.of_edge[c][e];
        if (f == kNone || !found_.families[f].meant) continue;
        const Point d = found_.families[f].direction;
        const std::uint32_t axis = d == axes[0] ? 0 : d == axes[1] ? 1 : kNone;
        if (axis == kNone) edges_[f][group_of_[c]].push_back({c, e});
        else if (exact_cross(exact_point(d), vector({c, e})) == 0) axis_of_[c][e] = axis;
        else ++result_[chains_[c].set].loose_edges;
      }
    }
  }

  std::uint32_t root_of(std::uint32_t f) const {
    while (found_.families[f].across != kNone) f = found_.families[f].across;
    return f;
  }
  /// Exact directions: those of axes as they are, with all at right angles to these; else that of a family's edges.
  void find_directions() {
    std::vector<bool> is_axis(found_.families.size());
    for (std::uint32_t f = 0; f < found_.families.size(); ++f) {
      const Point d = found_.families[f].direction;
      const bool used = std::any_of(groups_.begin(), groups_.end(),
                                    [&](const AlongAxes& group) { return d == group.axes[0] || d == group.axes[1]; });
      if (used || d.x == 0 || d.y == 0) is_axis[root_of(f)] = true;
    }
    direction_.resize(found_.families.size());
    for (const auto& [f, by_group] : edges_) {
      const std::uint32_t root = root_of(f);
      if (is_axis[root]) {
        direction_[f] = primitive(exact_point(found_.families[f].direction));
        continue;
      }
      Position d = direction_of_edges(root);
      for (std::uint32_t g = f; g != root; g = found_.families[g].across) d = {-d.y, d.x};
      direction_[f] = std::move(d);
    }
  }
  /// Along the axes of the group that has the most of a family, where its edges are parallel there.
  Position direction_of_edges(std::uint32_t f) const {
    const Position rounded = primitive(exact_point(found_.families[f].direction));
    const auto of_family = edges_.find(f);
    if (of_family == edges_.end()) return rounded;
    double most = 0;
    const std::vector<FamilyEdge>* edges = nullptr;
    for (const auto& [group, list] : of_family->second) {
      double length = 0;
      for (const FamilyEdge& e : list) length += length_of(e);
      if (length > most) most = length, edges = &list;
    }
    const Position first = vector((*edges)[0]);
    if (first.x == 0 && first.y == 0) return rounded;
    const auto parallel = [&](const std::vector<FamilyEdge>& list) {
      return std::all_of(list.begin(), list.end(),
                         [&](const FamilyEdge& e) { return exact_cross(first, vector(e)) == 0; });
    };
    // One edge is parallel to itself, which says nothing unless those of other groups are so, too.
    const bool says_something = edges->size() > 1 || of_family->second.size() > 1;
    const bool all = std::all_of(of_family->second.begin(), of_family->second.end(),
                                 [&](const auto& group) { return parallel(group.second); });
    return says_something && (all || (edges->size() > 1 && parallel(*edges))) ? primitive(first) : rounded;
  }

  /// An edge's ends above the midpoint of its group, and about where that is in units of length.
  struct EdgeHeight {
    FamilyEdge edge;
    BigRational from, to;
    double at = 0;
  };

  void add_lines(std::uint32_t family, std::size_t group, const std::vector<FamilyEdge>& edges) {
    const Position& d = direction_[family];
    const double size = std::hypot(exact::round_to_double(d.x), exact::round_to_double(d.y));
    const BigRational center = exact_cross(d, groups_[group].center);
    const std::size_t set = chains_[edges[0].chain].set;
    std::vector<EdgeHeight> heights;
    for (const FamilyEdge& e : edges) {
      const LineChain& chain = chains_[e.chain];
      const std::vector<Position>& at = along_axes_[set].at;
      EdgeHeight h{e, exact_cross(d, at[chain.from(e.edge)]) - center, exact_cross(d, at[chain.to(e.edge)]) - center};
      h.at = (exact::round_to_double(h.from) + exact::round_to_double(h.to)) / 2 / size;
      heights.push_back(std::move(h));
    }
    std::stable_sort(heights.begin(), heights.end(),
                     [](const EdgeHeight& a, const EdgeHeight& b) { return a.at < b.at; });
    for (std::size_t first = 0, last = 0; first < heights.size(); first = last) {
      while (last < heights.size() && heights[last].at - heights[first].at <= sets_[set].tolerance / 2) ++last;
      const std::span run(heights.data() + first, last - first);
      for (std::size_t k = 1; k < run.size(); ++k) result_[set].merged += run[k].at != run[k - 1].at;
      lines_.push_back({family, center + height_of(run, size, sets_[set].unit)});
      for (const EdgeHeight& h : run)
        line_of_[h.edge.chain][h.edge.edge] = static_cast<std::uint32_t>(lines_.size() - 1);
    }
  }
  /// That of all edges of a run, if they have one; else a multiple of a unit.
  static BigRational height_of(std::span<const EdgeHeight> run, double size, double unit_of_length) {
    const bool one = std::all_of(run.begin(), run.end(),
                                 [&](const EdgeHeight& h) { return h.from == run[0].from && h.to == run[0].from; });
    if (one) return run[0].from;
    const double unit = exact::power_below(unit_of_length * size);
    return exact_value(std::nearbyint((run.front().at + run.back().at) / 2 * size / unit) * unit);
  }

  /// The edge that arrives at a vertex of a chain, and the one that leaves.
  std::uint32_t edge_before(const LineChain& chain, std::uint32_t k) const {
    return k > 0 ? k - 1 : chain.closed ? chain.count - 1 : kNone;
  }
  std::uint32_t edge_after(const LineChain& chain, std::uint32_t k) const { return k < chain.edges() ? k : kNone; }

  void move_vertices(std::size_t c) {
    const LineChain& chain = chains_[c];
    PlacedOnLines& result = result_[chain.set];
    std::vector<std::uint32_t> open;
    for (std::uint32_t k = chain.count; k-- > 0;) open.push_back(k);
    while (!open.empty()) {
      const std::uint32_t k = open.back();
      open.pop_back();
      const std::optional<Position> at = position(c, k);
      const LineSet& set = sets_[chain.set];
      if (at && distance_above(*at, set.at[chain.first + k]) <= set.tolerance) {
        result.at[chain.first + k] = *at;
        continue;
      }
      const std::uint32_t loose = edge_to_free(c, k);
      line_of_[c][loose] = kNone;
      ++result.loose_edges;
      open.push_back(chain.to(loose) - chain.first);
      open.push_back(loose);
    }
  }
  /// The shorter one that is on a line.
  std::uint32_t edge_to_free(std::size_t c, std::uint32_t k) const {
    const std::uint32_t before = edge_before(chains_[c], k), after = edge_after(chains_[c], k);
    if (before == kNone || line_of_[c][before] == kNone) return after;
    if (after == kNone || line_of_[c][after] == kNone) return before;
    return length_of({c, before}) < length_of({c, after}) ? before : after;
  }

  /// Nothing where two parallel lines do not meet.
  std::optional<Position> position(std::size_t c, std::uint32_t k) const {
    const std::uint32_t before = edge_before(chains_[c], k), after = edge_after(chains_[c], k);
    const std::uint32_t in = before == kNone ? kNone : line_of_[c][before],
                        out = after == kNone ? kNone : line_of_[c][after];
    const Position& at = along_axes_[chains_[c].set].at[chains_[c].first + k];
    if (in == kNone && out == kNone) return at;
    if (in != kNone && out != kNone && in != out) return meeting(lines_[in], lines_[out]);
    const ExactLine& line = lines_[in != kNone ? in : out];
    const std::uint32_t other = in == out ? kNone : in != kNone ? after : before;
    const std::uint32_t axis = other == kNone ? kNone : axis_of_[c][other];
    const Position& d = direction_[line.family];
    const BigRational off = line.height - exact_cross(d, at);
    if (off == 0) return at;
    const Position by = axis == kNone ? Position{-d.y, d.x} : exact_point(groups_[group_of_[c]].axes[axis]);
    const BigRational s = off / exact_cross(d, by);
    return Position{at.x + s * by.x, at.y + s * by.y};
  }
  std::optional<Position> meeting(const ExactLine& a, const ExactLine& b) const {
    const Position &d = direction_[a.family], &e = direction_[b.family];
    const BigRational det = exact_cross(d, e);
    if (det == 0) return std::nullopt;
    return Position{(a.height * e.x - b.height * d.x) / det, (a.height * e.y - b.height * d.y) / det};
  }

  const std::vector<LineSet>& sets_;
  const std::vector<LineChain>& chains_;
  const LineFamilies& found_;
  const std::vector<AlongAxes>& groups_;
  std::vector<PlacedOnLines> result_, along_axes_;
  std::vector<std::size_t> group_of_;                                              ///< of chains
  std::map<std::uint32_t, std::map<std::size_t, std::vector<FamilyEdge>>> edges_;  ///< family -> group -> edges
  std::vector<Position> direction_;                                                ///< of families with such edges
  std::vector<ExactLine> lines_;
  std::vector<std::vector<std::uint32_t>> line_of_, axis_of_;  ///< chain -> edge -> line, axis
};

}  // namespace

double distance_above(const Position& at, Point from) {
  const auto off = [](const BigRational& c, double d) {
    return exact::round_to_double(BigRational(c - exact_value(d)));
  };
  const double moved = std::hypot(off(at.x, from.x), off(at.y, from.y));
  // Above what was rounded, also where that is subnormal.
  return moved > 0 ? moved * (1 + 0x1p-48) + 0x1p-1071 : 0;
}

std::vector<PlacedOnLines> edges_on_lines(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains,
                                          const LineFamilies& found, const std::vector<AlongAxes>& groups) {
  return LinePlacement(sets, chains, found, groups).run();
}

}  // namespace dymsum::planar
