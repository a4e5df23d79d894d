#include "shape/disc/level_set.h"

#include <algorithm>
#include <cmath>

#include "base/scratch.h"
#include "shape/disc/level_rings.h"
#include "shape/disc/run_pieces.h"
#include "shape/disc/tight_features.h"

namespace dymsum::shape {

namespace {

Pieces moved_pieces(const DiscPositions& positions, const BoundaryOrder& order, const LevelRings& rings,
                    const std::vector<std::uint32_t>& ring) {
  Pieces pieces;
  for (const std::uint32_t run : ring) append_moved(positions, order, rings.runs[run], pieces);
  return pieces;
}

/// Components of the region that a sum joins: across edges of the complex below the radius, and along its rings.
UnionFind joined_components(const DiscPositions& positions, const BoundaryOrder& order, const LevelRings& rings) {
  const Complex& complex = positions.complex();
  std::uint32_t components = 0;
  for (const Site& site : complex.sites) components = std::max(components, site.component + 1);
  UnionFind joined(components);
  for (const Edge& edge : complex.edges)
    if (edge.low < positions.level().below)
      joined.unite(complex.sites[edge.left].component, complex.sites[edge.right].component);
  const auto component = [&](std::uint32_t run) {
    return complex.sites[order.first_site[rings.runs[run].loop]].component;
  };
  for (const auto& ring : rings.rings)
    for (const std::uint32_t run : ring) joined.unite(component(ring.front()), component(run));
  return joined;
}

}  // namespace

void finish(const DiscPositions& positions, DiscSet& set) {
  set.radius = positions.level().radius;
  set.radius_exact = positions.level().text;
  set.at_error = positions.at_error();
}

DiscSet sum_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics) {
  const Complex& complex = positions.complex();
  const LevelRings rings =
      level_rings(complex, order, positions.level(), positions.level().up_to, Connected::region, true);
  UnionFind joined = joined_components(positions, order, rings);
  std::vector<OwnedRing> made;
  for (const auto& ring : rings.rings) {
    const std::uint32_t loop = rings.runs[ring.front()].loop;
    Pieces pieces = moved_pieces(positions, order, rings, ring);
    const bool outer = runs_counter_clockwise(positions, pieces.headings, Bend::counter_clockwise);
    made.push_back({{std::move(pieces.list)}, joined.root(complex.sites[order.first_site[loop]].component), outer});
  }
  DiscSet set;
  set.parts = parts_of(std::move(made));
  if (semantics == Semantics::open) {
    TightFeatures tight = tight_features(positions);
    set.tight_segments = std::move(tight.segments);
    set.tight_points = std::move(tight.points);
  }
  finish(positions, set);
  return set;
}

DiscSet eroded_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics) {
  const Complex& complex = positions.complex();
  const std::uint32_t cut = positions.level().up_to;
  const LevelRings rings = level_rings(complex, order, positions.level(), cut, Connected::discs, true);
  UnionFind joined(static_cast<std::uint32_t>(complex.nodes.size()));
  for (const Edge& edge : complex.edges)
    if (edge.low >= cut) joined.unite(edge.low, edge.high);
  std::vector<OwnedRing> made;
  for (const auto& ring : rings.rings) {
    const Run& run = rings.runs[ring.front()];
    const std::uint32_t item = run.whole() ? order.first_item[run.loop] : run.from;
    Pieces pieces = moved_pieces(positions, order, rings, ring);
    const bool outer = !runs_counter_clockwise(positions, pieces.headings, Bend::counter_clockwise);
    made.push_back({reversed(std::move(pieces.list)), joined.root(complex.edges[order.items[item].edge].high), outer});
  }
  DiscSet set;
  set.parts = parts_of(std::move(made));
  if (semantics != Semantics::regular) {
    TightFeatures tight = tight_features(positions);
    set.tight_segments = tight.segments;
    set.tight_points = tight.points;
    if (semantics == Semantics::closed) {
      set.segments = std::move(tight.segments);
      set.points = std::move(tight.points);
    }
  }
  finish(positions, set);
  return set;
}

}  // namespace dymsum::shape
