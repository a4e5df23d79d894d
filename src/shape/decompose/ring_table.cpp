#include "shape/decompose/ring_table.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "exact/orient.h"

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

}  // namespace dymsum::shape
