#include "shape/disc/level_rings.h"

#include <unordered_map>

namespace dymsum::shape {
namespace {

/// Half-edges: 2 e walks edge e upwards, 2 e + 1 downwards. The site lies on the left of either.
std::uint32_t site_of(const Complex& complex, std::uint32_t half) {
  const Edge& edge = complex.edges[half / 2];
  return half % 2 == 0 ? edge.left : edge.right;
}

/// The next half-edge with the same face on its left: the spoke after this one clockwise about its end.
std::vector<std::uint32_t> followers(const Complex& complex) {
  std::vector<std::uint32_t> next(2 * complex.edges.size(), kNoIndex);
  for (std::uint32_t node = 0; node < complex.nodes.size(); ++node) {
    const std::uint32_t first = complex.first_spoke[node], last = complex.first_spoke[node + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const Spoke& in = complex.spokes[i];
      const Spoke& out = complex.spokes[i == first ? last - 1 : i - 1];
      next[2 * in.edge + (in.up ? 1 : 0)] = 2 * out.edge + (out.up ? 0 : 1);
    }
  }
  return next;
}

/// Appends the half-edges of a site in the order of its positions. Rays to infinity part them into two runs at most,
/// the second of which comes from there.
void append_site(const Complex& complex, const std::vector<std::uint32_t>& halves,
                 const std::vector<std::uint32_t>& next, std::vector<std::uint8_t>& has_previous,
                 BoundaryOrder& order) {
  const auto append_run = [&](std::uint32_t half) {
    for (const std::uint32_t begin = half;;) {
      order.item_of[half / 2][half % 2] = static_cast<std::uint32_t>(order.items.size());
      order.items.push_back({half / 2, site_of(complex, half), half % 2 == 0});
      const std::uint32_t follower = next[half];
      if (follower == kNoIndex || follower == begin || site_of(complex, follower) != site_of(complex, half)) return;
      half = follower;
    }
  };
  std::vector<std::uint32_t> from_position, from_infinity;
  for (const std::uint32_t half : halves) {
    if (has_previous[half]) continue;
    const bool infinite = half % 2 == 1 && complex.edges[half / 2].high == kNoIndex;
    (infinite ? from_infinity : from_position).push_back(half);
  }
  // A point all around which there is something has no first position.
  if (from_position.empty() && from_infinity.empty() && !halves.empty()) from_position.push_back(halves.front());
  for (const std::uint32_t half : from_position) append_run(half);
  for (const std::uint32_t half : from_infinity) append_run(half);
}

}  // namespace

BoundaryOrder boundary_order(const Complex& complex) {
  BoundaryOrder order;
  const std::vector<std::uint32_t> next = followers(complex);
  std::vector<std::uint8_t> has_previous(next.size(), 0);
  std::vector<std::vector<std::uint32_t>> halves(complex.sites.size());
  for (std::uint32_t half = 0; half < next.size(); ++half) {
    halves[site_of(complex, half)].push_back(half);
    if (next[half] != kNoIndex && site_of(complex, next[half]) == site_of(complex, half)) has_previous[next[half]] = 1;
  }
  order.item_of.resize(complex.edges.size());
  for (std::uint32_t site = 0; site < complex.sites.size(); ++site) {
    if (site == 0 || complex.sites[site].loop != complex.sites[site - 1].loop) {
      order.first_site.push_back(site);
      order.first_item.push_back(static_cast<std::uint32_t>(order.items.size()));
    }
    append_site(complex, halves[site], next, has_previous, order);
  }
  order.first_site.push_back(static_cast<std::uint32_t>(complex.sites.size()));
  order.first_item.push_back(static_cast<std::uint32_t>(order.items.size()));
  return order;
}

namespace {

bool starts_run(const Complex& complex, const BoundaryItem& item, std::uint32_t cut) {
  return item.up && crosses(complex.edges[item.edge], cut);
}
bool ends_run(const Complex& complex, const BoundaryItem& item, std::uint32_t cut) {
  return !item.up && crosses(complex.edges[item.edge], cut);
}

/// The runs of a loop: beginnings and ends of runs take turns along it.
void append_runs(const Complex& complex, const BoundaryOrder& order, std::uint32_t loop, std::uint32_t cut,
                 LevelRings& made) {
  const std::uint32_t first = order.first_item[loop], last = order.first_item[loop + 1];
  const std::size_t before = made.runs.size();
  std::uint32_t end_of_wrapped = kNoIndex;
  for (std::uint32_t i = first; i < last; ++i) {
    const BoundaryItem& item = order.items[i];
    if (starts_run(complex, item, cut)) {
      made.run_from[item.edge] = static_cast<std::uint32_t>(made.runs.size());
      made.runs.push_back({loop, i, kNoIndex});
    } else if (ends_run(complex, item, cut)) {
      if (made.runs.size() == before) end_of_wrapped = i;
      else made.runs.back().to = i;
    }
  }
  if (made.runs.size() > before) {
    if (made.runs.back().to == kNoIndex) made.runs.back().to = end_of_wrapped;
  } else if (first == last || complex.edges[order.items[first].edge].low >= cut) {
    made.rings.push_back({static_cast<std::uint32_t>(made.runs.size())});
    made.runs.push_back({loop, kNoIndex, kNoIndex});
  }
}

/// Cuts a cycle of runs where the node between two of them comes again.
void split_at_nodes(const Complex& complex, const BoundaryOrder& order, const Level& level,
                    const std::vector<std::uint32_t>& ring, LevelRings& made) {
  std::vector<std::uint32_t> open;
  std::unordered_map<std::uint32_t, std::size_t> seen;  // node -> runs of `open` in front of it
  for (const std::uint32_t run : ring) {
    const std::uint32_t node = complex.edges[order.items[made.runs[run].from].edge].low;
    if (level.holds(node)) {
      const auto [found, is_new] = seen.try_emplace(node, open.size());
      if (!is_new) {
        const std::size_t begin = found->second;
        made.rings.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(begin), open.end());
        open.resize(begin);
        std::erase_if(seen, [begin](const auto& entry) { return entry.second > begin; });
      }
    }
    open.push_back(run);
  }
  made.rings.push_back(std::move(open));
}

}  // namespace

std::uint32_t edge_after(const Complex& complex, const Level& level, std::uint32_t edge, Connected connected) {
  const std::uint32_t node = complex.edges[edge].low;
  if (connected == Connected::discs || !level.holds(node)) return edge;
  const std::uint32_t first = complex.first_spoke[node], last = complex.first_spoke[node + 1];
  std::uint32_t here = first;
  while (complex.spokes[here].edge != edge) ++here;
  // Clockwise from here; itself where no other rises.
  for (std::uint32_t i = here == first ? last - 1 : here - 1;; i = i == first ? last - 1 : i - 1) {
    const Spoke& spoke = complex.spokes[i];
    if (spoke.up && !complex.edges[spoke.edge].flat) return spoke.edge;
  }
}

LevelRings level_rings(const Complex& complex, const BoundaryOrder& order, const Level& level, std::uint32_t cut,
                       Connected connected, bool split) {
  LevelRings made;
  made.run_from.assign(complex.edges.size(), kNoIndex);
  for (std::uint32_t loop = 0; loop < order.loops(); ++loop) append_runs(complex, order, loop, cut, made);
  std::vector<std::uint8_t> done(made.runs.size(), 0);
  for (std::uint32_t start = 0; start < done.size(); ++start) {
    if (done[start] || made.runs[start].whole()) continue;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t run = start; !done[run];) {
      done[run] = 1;
      ring.push_back(run);
      const std::uint32_t end = order.items[made.runs[run].to].edge;
      run = made.run_from[edge_after(complex, level, end, connected)];
    }
    if (split) split_at_nodes(complex, order, level, ring, made);
    else made.rings.push_back(std::move(ring));
  }
  return made;
}

}  // namespace dymsum::shape
