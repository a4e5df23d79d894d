// What other discs leave of the arcs of corner discs.
#include <map>
#include <type_traits>
#include <utility>

#include "base/scratch.h"
#include "shape/disc/arc_group.h"
#include "shape/disc/lazy_vector.h"

namespace dymsum::shape {

namespace {

/// Nodes below the cut by connected parts.
UnionFind parts_below(const Complex& complex, std::uint32_t cut) {
  UnionFind parts(cut);
  for (const Edge& edge : complex.edges)
    if (edge.low < cut && edge.high < cut) parts.unite(edge.low, edge.high);
  return parts;
}

}  // namespace

void cut_arcs(const DiscPositions& positions, std::uint32_t cut, ArcSet& arcs) {
  const Complex& complex = positions.complex();
  UnionFind parts = parts_below(complex, cut);
  for (std::uint32_t node = 0; node < cut; ++node) arcs.part.push_back(parts.root(node));
  arcs.is_split.assign(cut, 0);
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t arc = 0; arc < arcs.arcs.size(); ++arc)
    groups[parts.root(complex.edges[arcs.arcs[arc].edge].low)].push_back(arc);
  arcs.first.assign(arcs.arcs.size(), kNoIndex);
  for (auto& [root, members] : groups) {
    const std::size_t overlaps = arcs.overlaps.size(), touches = arcs.touches.size();
    cut_group(positions, arcs, members);
    arcs.is_split[root] = arcs.overlaps.size() > overlaps || arcs.touches.size() > touches;
  }
}

namespace {

/// formula(centre of other - centre of disc, r) as doubles.
template <class Formula>
Point between_centres(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other,
                      const Formula& formula) {
  const Complex& complex = positions.complex();
  const std::uint32_t edge = disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
  const Point origin = complex.sites[complex.edges[edge].left].a;
  if (disc.at_node || other.at_node) {
    const auto v = formula(minus(positions.exact_centre_from(other, origin), positions.exact_centre_from(disc, origin)),
                           positions.level().exact);
    return Point{exact::nearest_double(v.x), exact::nearest_double(v.y)};
  }
  return near_vector(
      [&](const auto& r) {
        return formula(
            minus(centre_on_edge(complex, other.index, r, origin), centre_on_edge(complex, disc.index, r, origin)), r);
      },
      positions.level(), positions.level().radius);
}

}  // namespace

Point towards_crossing(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other, bool entered) {
  return between_centres(positions, disc, other,
                         [&](const auto& d, const auto& r) { return crossing(d, r, !entered); });
}

Point towards_touch(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other) {
  return between_centres(positions, disc, other, [](const auto& d, const auto& r) {
    const std::decay_t<decltype(r)> half(0.5);
    return std::decay_t<decltype(d)>{half * d.x, half * d.y};
  });
}

}  // namespace dymsum::shape
