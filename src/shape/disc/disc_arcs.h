// Arcs of the corner discs of a level: what is left of them where such discs overlap.
#pragma once

#include <array>
#include <optional>

#include "shape/disc/boundary_order.h"
#include "shape/disc/disc_positions.h"
#include "shape/disc/level_rings.h"

namespace dymsum::shape {

/// An arc about a corner disc, clockwise between two positions that the disc touches one after the other: across an
/// edge of the complex that descends from its centre, less than half a turn, or half a turn across a flat edge.
struct CornerArc {
  std::uint32_t disc = 0;                          ///< into ArcSet::discs
  std::uint32_t edge = 0;                          ///< of the complex, across which it goes
  std::uint32_t start = 0, stop = 0;               ///< sites that the disc touches at its ends
  std::optional<Point> start_vertex, stop_vertex;  ///< where that is a vertex, or an edge's end
  std::uint32_t next = kNoIndex;                   ///< the arc that begins where it stops; kNoIndex: the run of `out`
  std::uint32_t out = 0;                           ///< edge of the complex on which the next run begins
};

/// What no other corner disc covers of an arc. It begins and ends where the arc does, or on the circle of another disc.
struct ArcFragment {
  std::uint32_t arc = 0;
  std::uint32_t begin = kNoIndex, end = kNoIndex;  ///< the disc that is left there, or entered; kNoIndex: a contact
  std::uint32_t next = kNoIndex;                   ///< the fragment that goes on where the end is no contact
  bool touches_at_begin = false, touches_at_end = false;  ///< that disc is not left or entered, but touched
  bool joined = false;                                    ///< the one before has taken it over
};

struct ArcSet {
  std::vector<CornerDisc> discs;
  std::vector<std::uint32_t> disc_edge;  ///< disc -> an edge of the complex on which a run ends at it
  std::vector<CornerArc> arcs;           ///< those of a corner follow each other
  std::vector<std::uint32_t> arc_after;  ///< edge of the complex -> the arc after the run that ends on it, or kNoIndex
  /// Edge of the complex -> the arc across it about a disc at its low end (flat edges), and at its high one or between.
  std::vector<std::array<std::uint32_t, 2>> arc_across;
  std::vector<ArcFragment> fragments;                  ///< those of an arc follow each other
  std::vector<std::uint32_t> first;                    ///< arc -> its fragment that begins at its start, or kNoIndex
  std::vector<std::array<std::uint32_t, 2>> overlaps;  ///< discs that overlap
  std::vector<std::array<std::uint32_t, 2>> touches;   ///< fragments that end where their discs touch; their arcs go on
  std::vector<std::uint32_t> part;     ///< node below the cut -> one that stands for its connected part below the cut
  std::vector<std::uint8_t> is_split;  ///< the latter -> whether discs overlap or touch across the part
};

/// All arcs, whole: of every corner between a run and the next one, those from contact to contact. O(n).
ArcSet corner_arcs(const DiscPositions& positions, const BoundaryOrder& order, const LevelRings& rings);

/// Adds fragments and overlaps. Discs overlap only within one connected part of the complex below the level: any way
/// from one to the other leads through it. (docs/design/disc-sum.md)
void cut_arcs(const DiscPositions& positions, std::uint32_t cut, ArcSet& arcs);

/// Takes the fragment that follows on the same arc, across a position where another disc touches, into this one.
void join(ArcSet& arcs, std::uint32_t fragment);
/// The fragment into which this one was taken, or itself.
std::uint32_t joined_into(const ArcSet& arcs, std::uint32_t fragment);

/// The vector from the centre of a disc to where the circle of another one is entered, going clockwise (`entered`), or
/// left.
Point towards_crossing(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other, bool entered);
/// The same where they touch: the midpoint between the centres.
Point towards_touch(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other);

}  // namespace dymsum::shape
