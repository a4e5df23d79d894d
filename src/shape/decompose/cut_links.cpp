#include "shape/decompose/cut_links.h"

#include <algorithm>
#include <limits>

namespace dymsum::shape {
namespace {

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

}  // namespace

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

}  // namespace dymsum::shape
