// What is left of the segments of a soup outside covered cells of two grids.
#pragma once

#include <cstdint>
#include <optional>

#include "base/poll.h"
#include "planar/arrangement/covered_translates.h"
#include "planar/arrangement/crossings.h"
#include "planar/mask/fine_cells.h"

namespace dymsum::planar {

/// How many segments pass each cell of the mask that is live; of each only its span, where there are spans.
struct CellVisits {
  Array<std::uint32_t> count;  ///< row by row
  std::uint64_t pairs = 0;     ///< of segments in one cell, over all cells
};
CellVisits count_visits(const Soup& soup, const Array<Span>& spans, const InteriorMask& mask, const Poll& poll);

/// Refines the cells that `crowd` segments or more pass. Stops, and returns false, when a sample of them shows little
/// gain.
bool refine_crowded(FineCells& cells, const CellVisits& visits, std::uint32_t crowd, const Poll& poll);

/// The parts of the segments in live fine cells, and in their spans where there are some; and marks in the parts
/// between them, which lie in covered cells. Pieces of a segment are disjoint and in its order. A segment without
/// pieces lies in covered cells altogether.
struct LivePieces {
  explicit LivePieces(Scratch* memory) : pieces(memory), marks(memory) {}
  Array<SegmentPiece> pieces;
  Array<CoveredMark> marks;
};
LivePieces live_pieces(const Soup& soup, const Array<Span>& spans, const FineCells& cells, const Poll& poll);

/// Drops the segments without pieces from the soup, in which and in `live`, which gives segments for ids, the others
/// get new numbers.
void drop_covered(Soup& soup, Array<std::uint32_t>& live, LivePieces& pieces);

/// All of that, where so many pairs of segments lie in one cell that it pays; nothing is changed otherwise. Cells are
/// refined only where translates of edges that cover each other leave such a crowd.
struct Refined {
  FineCells cells;
  LivePieces live;
  bool fine = false;  ///< whether cells were refined
};
std::optional<Refined> refine(const Operand& p, const Operand& q, InteriorMask& mask, Soup& soup,
                              Array<std::uint32_t>& live, Refine when, const Poll& poll);

// What pairs of edges that cross each other prove to be covered, along segments, where cells are too coarse.

/// How many proper crossings a piece has with others, in the mean over a sample of them. O(n) for n pieces.
double crossings_each(const Soup& soup, const LivePieces& live, const Poll& poll);

/// The pieces without what edges of the operands prove to lie in the open sum, with a rim: where the rest ends, the
/// open sum goes on for `reach`. An edge e of P and an edge f of Q, reflected and moved to x, cross properly exactly
/// where x lies inside the parallelogram e + f, and there P and x - Q overlap. A piece is looked at at its midpoint:
/// what the parallelogram there covers is cut off, and where there is none the halves are looked at, a few times over.
/// Requires operands whose components all have area. O(k log n) for k pieces in the end and n edges, where what lies in
/// both operands' boxes near a position is little.
LivePieces uncrossed_pieces(const Soup& soup, const LivePieces& live, double reach, const Poll& poll);

}  // namespace dymsum::planar
