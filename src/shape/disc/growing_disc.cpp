#include "shape/disc/growing_disc.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/poll.h"
#include "base/scratch.h"
#include "dymsum/growing_disc.h"
#include "shape/disc/disc_positions.h"
#include "shape/disc/level_rings.h"
#include "shape/disc/run_pieces.h"

namespace dymsum::shape {
namespace {

// Positions of a disc that has no room: nodes and flat edges of exactly the radius at hand.

struct TightFeatures {
  std::vector<DiscSegment> segments;  ///< maximal
  std::vector<DiscCorner> points;     ///< that belong to no segment
};

DiscCorner centre_of_node(const Complex& complex, std::uint32_t node) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::centre;
  corner.disc = {true, node};
  corner.at = complex.nodes[node].centre;
  return corner;
}

struct Spokes {
  std::uint32_t rising = 0;
  std::vector<std::uint32_t> flat;
};

Spokes spokes_of(const Complex& complex, std::uint32_t node) {
  Spokes spokes;
  for (std::uint32_t i = complex.first_spoke[node]; i < complex.first_spoke[node + 1]; ++i) {
    const Spoke& spoke = complex.spokes[i];
    if (complex.edges[spoke.edge].flat) spokes.flat.push_back(spoke.edge);
    else if (spoke.up) ++spokes.rising;
  }
  return spokes;
}

/// Flat edges that meet at a node lie on one line, as the two walls between which the discs lie are opposite there.
bool goes_on(const Spokes& spokes) { return spokes.rising == 0 && spokes.flat.size() == 2; }

/// What of { d >= r } is not in the closure of { d > r }. O(n).
TightFeatures tight_features(const DiscPositions& positions) {
  const Complex& complex = positions.complex();
  TightFeatures made;
  for (std::uint32_t node = positions.level().below; node < positions.level().up_to; ++node) {
    const Spokes here = spokes_of(complex, node);
    if (here.rising == 0 && here.flat.empty()) made.points.push_back(centre_of_node(complex, node));
    if (goes_on(here)) continue;
    for (std::uint32_t edge : here.flat) {
      std::uint32_t end = node;
      for (;;) {
        end = complex.edges[edge].low == end ? complex.edges[edge].high : complex.edges[edge].low;
        const Spokes there = spokes_of(complex, end);
        if (!goes_on(there)) break;
        edge = there.flat[0] == edge ? there.flat[1] : there.flat[0];
      }
      if (node < end) made.segments.push_back({centre_of_node(complex, node), centre_of_node(complex, end)});
    }
  }
  return made;
}

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

namespace dymsum {

using shape::Complex;
using shape::Side;

namespace {

bool goes_on(const Progress& progress, const char* stage, double fraction) {
  return !progress || progress(stage, fraction);
}
}  // namespace

/// The complex of each side with the order along the boundary, made when first requested.
struct GrowingDisc::State {
  Region region;
  GrowingDiscOptions options;
  struct OneSide {
    std::mutex mutex;
    bool made = false;
    std::optional<Error> error;
    Complex complex;
    shape::BoundaryOrder order;
  };
  OneSide sides[2];

  /// What is made stays so, and is read without the mutex; a call that is stopped leaves nothing.
  Result<const OneSide*> side(Side which, const Progress& progress) {
    OneSide& one = sides[which == Side::inside ? 1 : 0];
    const std::lock_guard lock(one.mutex);
    if (!one.made) {
      const auto engine = options.brute ? shape::Engine::brute : shape::Engine::fast;
      auto made = shape::make_complex(region, which, engine, 0, progress);
      if (!made && made.error().code == ErrorCode::cancelled) return made.error();
      if (!made) {
        one.error = made.error();
      } else {
        one.complex = *std::move(made);
        one.order = shape::boundary_order(one.complex);
      }
      one.made = true;
      if (!goes_on(progress, "complex", 1)) return cancelled();
    }
    if (one.error) return *one.error;
    return &one;
  }
};

namespace {

using Make = DiscSet (*)(const shape::DiscPositions&, const shape::BoundaryOrder&, Semantics);

template <class OneSide>
Result<DiscSet> set_at(const Result<const OneSide*>& side, const Region& region, const DiscRadius& r,
                       Semantics semantics, const Progress& progress, Make make) {
  if (!side) return side.error();
  const OneSide& one = **side;
  if (!goes_on(progress, "set", 0)) return cancelled();
  const auto level = shape::level_at(one.complex, r);
  if (!level) return level.error();
  if (level->radius == 0) return shape::set_of(region);
  DiscSet set = make(shape::DiscPositions(one.complex, *level), one.order, semantics);
  if (!goes_on(progress, "set", 1)) return cancelled();
  return set;
}

}  // namespace

GrowingDisc::GrowingDisc(Region region, GrowingDiscOptions options) : state_(std::make_shared<State>()) {
  state_->region = std::move(region);
  state_->options = options;
}

const Region& GrowingDisc::region() const { return state_->region; }

Result<std::vector<DiscEvent>> GrowingDisc::events(DiscSide side, const Progress& progress) const {
  const auto one = state_->side(side == DiscSide::inside ? Side::inside : Side::outside, progress);
  if (!one) return one.error();
  return shape::disc_events((*one)->complex);
}

Result<DiscSet> GrowingDisc::sum_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::outside, progress), region(), r, semantics, progress, shape::sum_set);
}

Result<DiscSet> GrowingDisc::eroded_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::inside, progress), region(), r, semantics, progress, shape::eroded_set);
}

Result<DiscSet> GrowingDisc::opened_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::inside, progress), region(), r, semantics, progress, shape::opened_set);
}

Result<DiscSet> GrowingDisc::closed_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::outside, progress), region(), r, semantics, progress, shape::closed_set);
}

}  // namespace dymsum
