#include "shape/decompose/cut_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "base/scratch.h"
#include "dymsum/rational.h"
#include "exact/orient.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {
namespace {

// What cuts connect. A cut separates something exactly where the rings and cuts that it connects are connected without
// it, too.

/// Rings are connected twice where every cut between them separates two pieces; they make one block. Cuts are added in
/// rounds; when a round is closed, all rings that are connected are connected twice.
class CutLinks {
 public:
  explicit CutLinks(const RingTable& table);

  struct Stop {
    Rational t;          ///< along the cut
    std::uint32_t node;  ///< a ring, or a position where cuts of this round meet
  };
  /// The next cut: from a ring, over the boundaries of holes, to a ring or, at t, to an earlier cut.
  struct End {
    bool on_cut;
    std::uint32_t index;  ///< ring or cut
    Rational t;           ///< along that cut
  };
  void add(std::uint32_t from, std::vector<Stop> over, const End& end);

  /// Rings connected twice with each other, without the outer one, that only `cut` connects with others.
  struct Loose {
    std::vector<std::uint32_t> rings;
    std::uint32_t cut;
  };
  /// The one with the ring of the least rank, or nothing where every cut separates. O(cuts of the round + rings).
  std::optional<Loose> first_loose();

  /// Requires: there is nothing loose.
  void close_round();

 private:
  struct Link {
    std::uint32_t a, b, cut;
  };
  std::uint32_t node_of(const End& end);
  std::vector<Link> links();

  const RingTable& table_;
  std::vector<std::uint32_t> ranked_;        ///< rings, for ties
  UnionFind blocks_;                         ///< of rings
  std::vector<std::uint32_t> ring_of_;       ///< cut -> ring that it begins at
  std::vector<std::vector<Stop>> stops_;     ///< per cut of the round, in their order
  std::uint32_t first_cut_ = 0, meets_ = 0;  ///< of the round
  bool joins_ = false;                       ///< whether a cut of the round connects different blocks
};

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Nodes and links, and which links are bridges: the only way between their ends.
class LinkGraph {
 public:
  LinkGraph(std::uint32_t nodes, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links)
      : links_(links), at_(nodes), found_(nodes, kNone), low_(nodes), bridge_(links.size(), false) {
    for (std::uint32_t l = 0; l < links.size(); ++l) {
      at_[links[l].first].push_back(l);
      at_[links[l].second].push_back(l);
    }
    for (std::uint32_t n = 0; n < nodes; ++n)
      if (found_[n] == kNone) walk(n);
  }
  bool is_bridge(std::uint32_t l) const { return bridge_[l]; }

 private:
  struct Step {
    std::uint32_t node, by, next = 0;
  };
  // Tarjan: a link of the search tree is a bridge where nothing found below it links to something found above.
  void walk(std::uint32_t root) {
    std::vector<Step> stack{{root, kNone}};
    found_[root] = low_[root] = clock_++;
    while (!stack.empty()) {
      const std::uint32_t node = stack.back().node, by = stack.back().by;
      if (stack.back().next == at_[node].size()) {
        stack.pop_back();
        if (by == kNone) continue;
        const std::uint32_t parent = stack.back().node;
        low_[parent] = std::min(low_[parent], low_[node]);
        bridge_[by] = low_[node] > found_[parent];
        continue;
      }
      const std::uint32_t link = at_[node][stack.back().next++];
      if (link == by) continue;
      const std::uint32_t other = links_[link].first ^ links_[link].second ^ node;
      if (found_[other] != kNone) {
        low_[node] = std::min(low_[node], found_[other]);
        continue;
      }
      found_[other] = low_[other] = clock_++;
      stack.push_back({other, link});
    }
  }

  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links_;
  std::vector<std::vector<std::uint32_t>> at_;
  std::vector<std::uint32_t> found_, low_;
  std::vector<bool> bridge_;
  std::uint32_t clock_ = 0;
};

CutLinks::CutLinks(const RingTable& table)
    : table_(table), ranked_(table.ranked_rings()), blocks_(table.ring_count()) {}

std::uint32_t CutLinks::node_of(const End& end) {
  if (!end.on_cut) return end.index;
  if (end.index < first_cut_) return ring_of_[end.index];
  std::vector<Stop>& stops = stops_[end.index - first_cut_];
  const auto after = std::lower_bound(stops.begin(), stops.end(), end.t,
                                      [](const Stop& stop, const Rational& t) { return stop.t < t; });
  if (after->t == end.t) return after->node;
  return stops.insert(after, {end.t, table_.ring_count() + meets_++})->node;
}

void CutLinks::add(std::uint32_t from, std::vector<Stop> over, const End& end) {
  const std::uint32_t other = end.on_cut ? ring_of_[end.index] : end.index;
  joins_ = joins_ || !blocks_.same(from, other);
  for (const Stop& stop : over) joins_ = joins_ || !blocks_.same(from, stop.node);
  over.insert(over.begin(), {Rational(0), from});
  over.push_back({Rational(1), node_of(end)});
  std::stable_sort(over.begin(), over.end(), [](const Stop& a, const Stop& b) { return a.t < b.t; });
  stops_.push_back(std::move(over));
  ring_of_.push_back(from);
}

/// The links between rings, each the first of its block, and meets. What begins and ends at one block separates
/// provably.
std::vector<CutLinks::Link> CutLinks::links() {
  const auto block = [&](std::uint32_t node) { return node < table_.ring_count() ? blocks_.root(node) : node; };
  std::vector<Link> links;
  for (std::uint32_t c = 0; c < stops_.size(); ++c)
    for (std::size_t i = 0; i + 1 < stops_[c].size(); ++i) {
      const std::uint32_t a = block(stops_[c][i].node), b = block(stops_[c][i + 1].node);
      if (a != b) links.push_back({a, b, first_cut_ + c});
    }
  return links;
}

std::optional<CutLinks::Loose> CutLinks::first_loose() {
  if (!joins_) return std::nullopt;
  const std::vector<Link> all = links();
  const std::uint32_t nodes = table_.ring_count() + meets_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const Link& link : all) ends.emplace_back(link.a, link.b);
  const LinkGraph graph(nodes, ends);
  UnionFind twice(nodes);
  for (std::uint32_t l = 0; l < all.size(); ++l)
    if (!graph.is_bridge(l)) twice.unite(all[l].a, all[l].b);
  std::vector<std::uint32_t> bridges(nodes, 0), cut(nodes, kNone);
  for (std::uint32_t l = 0; l < all.size(); ++l)
    if (graph.is_bridge(l))
      for (const std::uint32_t end : {all[l].a, all[l].b}) {
        ++bridges[twice.root(end)];
        cut[twice.root(end)] = all[l].cut;
      }
  std::vector<bool> outer(nodes, false);
  const auto class_of = [&](std::uint32_t ring) { return twice.root(blocks_.root(ring)); };
  for (std::uint32_t r = 0; r < table_.ring_count(); ++r)
    if (!table_.is_hole[r]) outer[class_of(r)] = true;
  std::uint32_t chosen = kNone;
  Loose loose;
  for (const std::uint32_t r : ranked_) {
    const std::uint32_t own = class_of(r);
    if (chosen == kNone && bridges[own] == 1 && !outer[own]) chosen = own;
    if (own == chosen) loose.rings.push_back(r);
  }
  if (chosen == kNone) return std::nullopt;
  std::sort(loose.rings.begin(), loose.rings.end());
  loose.cut = cut[chosen];
  return loose;
}

void CutLinks::close_round() {
  if (joins_) {
    UnionFind connected(table_.ring_count() + meets_);
    for (const std::vector<Stop>& stops : stops_)
      for (const Stop& stop : stops) connected.unite(stop.node, stops.front().node);
    std::vector<std::uint32_t> first(connected.size(), kNone);
    for (std::uint32_t r = 0; r < table_.ring_count(); ++r) {
      std::uint32_t& own = first[connected.root(r)];
      if (own == kNone) own = r;
      blocks_.unite(r, own);
    }
  }
  stops_.clear();
  first_cut_ = std::uint32_t(ring_of_.size());
  meets_ = 0;
  joins_ = false;
}

// The passages of a cut over holes that it ignores.

Rational passage_cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether a cut through v goes on inside the region.
bool enters_at(const RingTable& table, std::uint32_t v, const Wall& cut) {
  const Point at = table.at[v], next = table.at[table.next[v]], previous = table.at[table.previous[v]];
  const bool right_of_previous = side_of_end(at, previous, cut)<0, left_of_next = side_of_end(at, next, cut)> 0;
  return exact::orient_sign(previous, at, next) > 0 ? left_of_next && right_of_previous
                                                    : left_of_next || right_of_previous;
}

/// The passage at the first end of an edge, where that lies on the cut.
std::optional<Passage> at_vertex(const RingTable& table, const Wall& edge, const Wall& cut) {
  if (side_of(cut, edge.a) != 0) return std::nullopt;
  const RationalPoint from = cut.from(), to = cut.end(), at = edge.from();
  const Rational dx = to.x - from.x, dy = to.y - from.y;
  const Rational t = ((at.x - from.x) * dx + (at.y - from.y) * dy) / (dx * dx + dy * dy);
  if (t.sign() < 0 || t > Rational(1)) return std::nullopt;
  return Passage{true, edge.index, Rational(0), t, at, enters_at(table, edge.index, cut)};
}

/// The passage where the cut crosses an edge between its ends.
std::optional<Passage> inside_edge(const Wall& edge, const Wall& cut) {
  if (side_of(cut, edge.a) * side_of(cut, edge.b) >= 0) return std::nullopt;
  const int side = side_of_end(edge.a, edge.b, cut);
  if (exact::orient_sign(edge.a, edge.b, cut.a) * side >= 0) return std::nullopt;
  const RationalPoint a = edge.from(), b = edge.end(), from = cut.from(), to = cut.end();
  const Rational s = passage_cross(a, b, from), t = s / (s - passage_cross(a, b, to));
  const Rational u = passage_cross(from, to, a);
  return Passage{false,
                 edge.index,
                 u / (u - passage_cross(from, to, b)),
                 t,
                 {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)},
                 side > 0};
}

/// The positions of a cut on holes of its part that do not stand, in order along it. Exact.
std::vector<Passage> passages(const RingTable& table, const WallSet& walls, const Wall& cut,
                              const std::vector<bool>& stands) {
  std::vector<Passage> over;
  walls.edges_meeting(cut.box, [&](std::uint32_t e) {
    const Wall& edge = walls[e];
    if (stands[edge.ring] || table.part[edge.ring] != table.part[cut.ring]) return;
    if (std::optional<Passage> passage = at_vertex(table, edge, cut)) over.push_back(*std::move(passage));
    if (std::optional<Passage> passage = inside_edge(edge, cut)) over.push_back(*std::move(passage));
  });
  std::sort(over.begin(), over.end(), [](const Passage& a, const Passage& b) {
    return a.on_cut != b.on_cut ? a.on_cut < b.on_cut : a.index < b.index;
  });
  return over;
}

/// What of a cut lies inside the region, given where it passes holes.
std::vector<RationalSegment> runs_of(const Cut& cut, const std::vector<Passage>& over) {
  std::vector<RationalSegment> runs;
  RationalPoint from = cut.from;
  bool inside = true;
  for (const Passage& p : over) {
    if (inside && !p.enters) runs.push_back({from, p.at});
    if (!inside && p.enters) from = p.at;
    inside = p.enters;
  }
  if (inside) runs.push_back({from, cut.to});
  return runs;
}

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
