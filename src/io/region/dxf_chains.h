// Lines and arcs, joined where their ends meet.
#pragma once

#include <cstddef>
#include <vector>

#include "dymsum/region.h"
#include "io/source.h"

namespace dymsum::io {

struct DxfPiece {
  std::vector<Point> points;  ///< at least two
  double reach = 0;           ///< of an arc: ends that are at most so far from its own, in either coordinate, are these
  std::size_t offset = 0;     ///< in the text
};

struct DxfChains {
  std::vector<Ring> rings;
  std::vector<Polyline> polylines;
};

/// Joins ends that are equal, then ends within the reach of arcs; at a joint the coordinates of a line count. Closed
/// chains are rings. Error malformed where more than two ends meet. O(n log n) unless very many ends are within reach
/// of one another; beyond 10^8 comparisons that is an error, too.
DxfChains join_pieces(const Source& source, std::vector<DxfPiece> pieces);

}  // namespace dymsum::io
