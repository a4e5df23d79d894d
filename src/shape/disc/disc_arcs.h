// Arcs of the corner discs of a level: what is left of them where such discs overlap.
#pragma once

#include "shape/disc/boundary_order.h"
#include "shape/disc/disc_places.h"
#include "shape/disc/level_rings.h"

namespace dymsum::shape {

/// The arc about a corner disc between a run of places and the next one: clockwise from where the disc touches the site
/// on the right of edge `in` of the complex to where it touches the one on the left of `out`, at most half a turn.
struct CornerArc {
  CornerDisc disc;
  std::uint32_t in = 0, out = 0;
};

/// What no other corner disc covers of an arc. It begins and ends where the arc does, or on the circle of another disc.
struct ArcFragment {
  static constexpr std::uint32_t kContact = 0xffffffff;
  std::uint32_t arc = 0;
  std::uint32_t begin = kContact, end = kContact;  ///< an arc whose disc is left there, or entered
  std::uint32_t next = kContact;                   ///< the fragment that goes on where the end is no contact
};

struct ArcSet {
  std::vector<CornerArc> arcs;           ///< one for each run that has an end
  std::vector<ArcFragment> fragments;    ///< those of an arc follow each other
  std::vector<std::uint32_t> first;      ///< arc -> into fragments, where its first one begins at its contact; else kContact
  std::vector<std::uint32_t> arc_at_end; ///< edge of the complex -> the arc with that `in`, or kContact
  std::vector<std::array<std::uint32_t, 2>> overlaps;  ///< arcs whose discs overlap
  std::vector<std::uint8_t> split;       ///< node -> whether overlapping discs lie about its part of the complex, by its root
  std::vector<std::uint32_t> root;       ///< node below the cut -> a node that stands for its connected part below it
};

/// Discs overlap only within one connected part of the complex below the level: any way from one to the other leads
/// through it. (docs/design/disc-sum.md)
ArcSet corner_arcs(const DiscPlaces& places, const BoundaryOrder& order, const LevelRings& rings, std::uint32_t cut);

/// From the centre of a disc to where the circle of another one is entered, going clockwise (`entered`), or left.
Point towards_crossing(const DiscPlaces& places, const CornerDisc& disc, const CornerDisc& other, bool entered);

}  // namespace dymsum::shape
