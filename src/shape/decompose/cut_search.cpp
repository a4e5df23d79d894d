#include "shape/decompose/cut_search.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "exact/orient.h"
#include "shape/decompose/cut_links.h"
#include "shape/decompose/passages.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {
namespace {

struct Candidate {
  std::uint32_t vertex, wall;
  Nearest end;
};

std::vector<Wall> walls_of(const RingTable& table) {
  std::vector<Wall> walls;
  for (std::uint32_t v = 0; v < table.at.size(); ++v)
    walls.push_back(edge_wall(table.at[v], table.at[table.next[v]], v, table.ring[v]));
  return walls;
}

/// Vertices of the convex hull without those in its edges, by rank.
std::vector<std::uint32_t> hull_vertices(const RingTable& table, const std::vector<std::uint32_t>& rings) {
  std::vector<std::uint32_t> all, hull;
  for (const std::uint32_t r : rings)
    for (std::uint32_t v = table.first[r]; v < table.first[r + 1]; ++v) all.push_back(v);
  std::sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(table.at[a].x, table.at[a].y, a) < std::tuple(table.at[b].x, table.at[b].y, b);
  });
  for (const int pass : {0, 1}) {  // the lower chain, the upper one
    const std::size_t base = hull.size();
    for (const std::uint32_t v : all) {
      while (hull.size() >= base + 2 &&
             exact::orient_sign(table.at[hull[hull.size() - 2]], table.at[hull.back()], table.at[v]) <= 0)
        hull.pop_back();
      hull.push_back(v);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(all.begin(), all.end());
  }
  std::sort(hull.begin(), hull.end(), [&](std::uint32_t a, std::uint32_t b) { return table.rank[a] < table.rank[b]; });
  return hull;
}

class CutSearch {
 public:
  CutSearch(const RingTable& table, const std::vector<FeatureBar>& bars, const std::vector<BarWorth>& worth,
            const std::vector<std::uint32_t>& order)
      : table_(table),
        bars_(bars),
        worth_(worth),
        order_(order),
        walls_(walls_of(table)),
        links_(table),
        touching_(table.at.size()) {
    for (const bool hole : table.is_hole) stands_.push_back(!hole);
    std::vector<bool> seen(stands_);
    for (const std::uint32_t b : order)
      if (bars[b].minimum && !seen[table.ring[*bars[b].minimum]]) {
        seen[table.ring[*bars[b].minimum]] = true;
        first_of_[worth[b]].push_back(table.ring[*bars[b].minimum]);
      }
  }

  std::vector<PlacedCut> run(const Poll& poll) {
    std::vector<bool> done(table_.at.size(), false);
    for (std::size_t k = 0; k < order_.size(); ++k) {
      poll.at_test(k, order_.size());
      const FeatureBar& bar = bars_[order_[k]];
      if (k == 0 || worth_[order_[k]] != worth_[order_[k - 1]]) {
        add_partners(poll, double(k) / double(order_.size()));
        if (const auto found = first_of_.find(worth_[order_[k]]); found != first_of_.end())
          for (const std::uint32_t ring : found->second) stands_[ring] = true;
      }
      if (!bar.minimum || done[*bar.minimum]) continue;
      done[*bar.minimum] = true;
      if (const std::optional<Candidate> found = nearest_end(*bar.minimum)) add(*found, order_[k], false);
    }
    add_partners(poll, 1);
    return std::move(cuts_);
  }

 private:
  Notch notch_at(std::uint32_t v) const {
    return {table_.at[v], table_.at[table_.previous[v]], table_.at[table_.next[v]]};
  }

  /// Whether a cut that passes v, or begins or ends there, lies in the cone.
  bool resolved(std::uint32_t v, const Notch& notch) const {
    return std::any_of(touching_[v].begin(), touching_[v].end(), [&](std::uint32_t c) {
      const Cut& cut = cuts_[c].cut;
      const bool begins = cut.vertex == v, ends = cut.end == Cut::End::vertex && cut.index == v;
      const Wall& wall = walls_[std::uint32_t(table_.at.size()) + c];
      return (!begins && notch.admits(wall.a)) || (!ends && notch.admits_end(wall));
    });
  }

  bool can_end_at(const Wall& wall, std::uint32_t v) const {
    if (table_.part[wall.ring] != table_.part[table_.ring[v]]) return false;
    return wall.kind == Cut::End::cut || (stands_[wall.ring] && wall.index != v && table_.next[wall.index] != v);
  }

  /// The order of ends equally far: first those at a vertex whose own notch the cut resolves, too, then others on the
  /// boundary, by the ranks of what they lie on, then those on cuts.
  using Tie = std::tuple<int, std::uint32_t, std::uint32_t>;
  Tie tie_of(const Candidate& candidate) const {
    const Wall& wall = walls_[candidate.wall];
    if (wall.kind == Cut::End::cut) return {2, wall.index, 0};
    std::uint32_t a = wall.index, b = table_.next[wall.index];
    if (candidate.end.t == Rational(0)) b = a;
    if (candidate.end.t == Rational(1)) a = b;
    const bool resolves =
        a == b && table_.is_reflex(a) && notch_at(a).admits(table_.at[candidate.vertex]) && !resolved(a, notch_at(a));
    const auto [low, high] = std::minmax(table_.rank[a], table_.rank[b]);
    return {resolves ? 0 : 1, low, high};
  }

  /// The nearest position of what stands in the cone at v. Nothing where the notch is resolved.
  std::optional<Candidate> nearest_end(std::uint32_t v) const {
    const Notch notch = notch_at(v);
    if (resolved(v, notch)) return std::nullopt;
    double most = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, std::uint32_t>> near;
    walls_.near(notch, most, [&](std::uint32_t w) {
      if (!can_end_at(walls_[w], v)) return;
      const Notch::Estimate estimate = notch.estimate(walls_[w]);
      if (estimate.none || estimate.square.low() > most) return;
      near.emplace_back(estimate.square.low(), w);
      if (estimate.proved) most = std::min(most, estimate.square.high());
    });
    std::optional<Candidate> best;
    for (const auto& [least, w] : near) {
      if (least > most) continue;
      std::optional<Nearest> found = notch.nearest(walls_[w]);
      if (!found) continue;
      Candidate candidate{v, w, *std::move(found)};
      if (!best || candidate.end.square < best->end.square ||
          (candidate.end.square == best->end.square && tie_of(candidate) < tie_of(*best)))
        best = std::move(candidate);
    }
    return best;
  }

  void add(const Candidate& found, std::uint32_t bar, bool partner) {
    const Wall& wall = walls_[found.wall];
    const auto index = std::uint32_t(cuts_.size());
    Cut cut{found.vertex, wall.kind, wall.index, rational_point(table_.at[found.vertex]),
            found.end.at, bar,       partner,    {}};
    const Rational& t = found.end.t;
    const std::uint32_t ring = table_.ring[found.vertex];
    const CutLinks::End end{wall.kind == Cut::End::cut, wall.kind == Cut::End::cut ? wall.index : wall.ring, t};
    if (cut.end == Cut::End::edge && (t == Rational(0) || t == Rational(1))) {
      cut.end = Cut::End::vertex;
      if (t == Rational(1)) cut.index = table_.next[cut.index];
      touching_[cut.index].push_back(index);
    }
    touching_[cut.vertex].push_back(index);
    Wall made = cut_wall(table_.at[found.vertex], cut.to, index, ring);
    std::vector<Passage> over = passages(table_, walls_, made, stands_);
    cut.runs = runs_of(cut, over);
    std::vector<CutLinks::Stop> stops;
    for (const Passage& p : over) {
      stops.push_back({p.on_cut, table_.ring[p.index]});
      if (p.at_vertex) touching_[p.index].push_back(index);
    }
    for (const CutLinks::Stop& stop : stops) stands_[stop.node] = true;
    links_.add(ring, std::move(stops), end);
    cuts_.push_back({std::move(cut), t, std::move(over)});
    walls_.add(std::move(made));
  }

  /// Whether what ends at this wall would still hang, with these rings, on the one cut that connects them.
  bool hangs_too(const Wall& wall, const CutLinks::Loose& loose) const {
    return wall.kind == Cut::End::cut &&
           (wall.index == loose.cut || std::binary_search(loose.rings.begin(), loose.rings.end(), wall.ring));
  }

  /// The shortest cut at a vertex of the hull of these rings that connects them with others, or, where none does, the
  /// shortest. It leaves the hull: the cone there and the hull are apart.
  std::optional<Candidate> partner_of(const CutLinks::Loose& loose, const Poll& poll, double fraction) const {
    std::optional<Candidate> best;
    bool hangs = true;  // of the best
    for (const std::uint32_t v : hull_vertices(table_, loose.rings)) {
      poll(fraction);
      std::optional<Candidate> found = nearest_end(v);
      if (!found) continue;
      const bool new_hangs = hangs_too(walls_[found->wall], loose);
      if (best && (new_hangs != hangs ? new_hangs : found->end.square >= best->end.square)) continue;
      hangs = new_hangs;
      best = std::move(found);
    }
    return best;
  }

  void add_partners(const Poll& poll, double fraction) {
    while (const std::optional<CutLinks::Loose> loose = links_.first_loose()) {
      const std::optional<Candidate> partner = partner_of(*loose, poll, fraction);
      if (!partner) throw std::logic_error("rings that one cut connects have a second");
      add(*partner, cuts_[loose->cut].cut.bar, true);
    }
    links_.close_round();
  }

  const RingTable& table_;
  const std::vector<FeatureBar>& bars_;
  const std::vector<BarWorth>& worth_;
  const std::vector<std::uint32_t>& order_;
  WallSet walls_;
  CutLinks links_;
  std::vector<bool> stands_;                                 ///< per ring: cuts end there, and do not pass over it
  std::map<BarWorth, std::vector<std::uint32_t>> first_of_;  ///< holes by the most significant of their bars
  std::vector<std::vector<std::uint32_t>> touching_;         ///< vertex -> cuts
  std::vector<PlacedCut> cuts_;
};

}  // namespace

std::vector<PlacedCut> find_cuts(const RingTable& table, const std::vector<FeatureBar>& bars,
                                 const std::vector<BarWorth>& worth, const std::vector<std::uint32_t>& order,
                                 const Poll& poll) {
  return CutSearch(table, bars, worth, order).run(poll);
}

}  // namespace dymsum::shape
