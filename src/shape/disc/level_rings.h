// What lies beyond a level: runs of boundary positions whose rays go on, how they follow each other, and arcs at
// their ends.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "shape/complex/complex.h"
#include "shape/disc/disc_positions.h"

namespace dymsum::shape {

// The edges of a complex in the order in which the rays from the boundary meet them: once round each walk.

/// An edge of the complex as a site sees it: `up` where the walk along the site goes from its low node to its high one,
/// so that the site lies on the left of it; else from high to low, the site on the right.
struct BoundaryItem {
  std::uint32_t edge = 0, site = 0;
  bool up = false;
};

/// Items of a loop follow each other cyclically; where the rays between two of them go to infinity the first ends and
/// the next begins there. A loop without items sees nothing but infinity.
struct BoundaryOrder {
  std::vector<BoundaryItem> items;
  std::vector<std::uint32_t> first_item, first_site;  ///< loop -> into items, sites; one more than loops
  std::vector<std::array<std::uint32_t, 2>> item_of;  ///< edge -> its item up, its item down
  std::uint32_t loops() const { return static_cast<std::uint32_t>(first_site.size()) - 1; }
  std::uint32_t loop_of(const Complex& complex, std::uint32_t item) const {
    return complex.sites[items[item].site].loop;
  }
  std::uint32_t next(const Complex& complex, std::uint32_t item) const {
    const std::uint32_t loop = loop_of(complex, item);
    return item + 1 == first_item[loop + 1] ? first_item[loop] : item + 1;
  }
  std::uint32_t previous(const Complex& complex, std::uint32_t item) const {
    const std::uint32_t loop = loop_of(complex, item);
    return item == first_item[loop] ? first_item[loop + 1] - 1 : item - 1;
  }
};

/// O(nodes + edges).
BoundaryOrder boundary_order(const Complex& complex);

/// Positions of one walk, one after the other, whose discs grow beyond the level: from the item at which they begin to
/// that at which they end; a whole walk has no items.
struct Run {
  std::uint32_t loop = 0, from = kNoIndex, to = kNoIndex;
  bool whole() const { return from == kNoIndex; }
  friend bool operator==(const Run&, const Run&) = default;
};

/// Where several components meet at one node, rings keep those on one side of the boundary connected: the side of the
/// region that is walked round, or that of the discs.
enum class Connected : std::uint8_t { region, discs };

struct LevelRings {
  std::vector<Run> runs;
  std::vector<std::uint32_t> run_from;            ///< edge of the complex -> the run that begins on it, or kNoIndex
  std::vector<std::vector<std::uint32_t>> rings;  ///< of runs; whole walks are rings of their own
};

/// The edge at which the boundary goes on that came to a crossing of `edge`: itself, or at a node of the level where
/// the region stays connected that of the next component clockwise.
std::uint32_t edge_after(const Complex& complex, const Level& level, std::uint32_t edge, Connected connected);

/// Runs of positions whose edges of the complex lie beyond nodes [0, cut), with cut = level.below or level.up_to. Rings
/// that visit a node of the level twice are split there if `split`. O(n).
LevelRings level_rings(const Complex& complex, const BoundaryOrder& order, const Level& level, std::uint32_t cut,
                       Connected connected, bool split);

// Arcs of the corner discs of a level: what is left of them where such discs overlap.

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
