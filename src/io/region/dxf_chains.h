// Lines and arcs, joined where their ends meet.
#pragma once

#include <cstddef>
#include <vector>

#include "io/region/curves.h"
#include "io/source.h"

namespace dymsum::io {

struct DxfPiece {
  ChordChain chain;        ///< at least two vertices
  double reach = 0;        ///< of a curve: ends that are at most so far from its own, in either coordinate, are these
  std::size_t offset = 0;  ///< in the text
};

struct DxfChains {
  std::vector<ChordChain> rings, open;
};

/// Joins ends that are equal, then ends within the reach of curves; at a joint the coordinates of a line count. Closed
/// chains are rings. Error malformed where more than two ends meet. O(n log n) unless very many ends are within reach
/// of one another; beyond 10^8 comparisons that is an error, too.
DxfChains join_pieces(const Source& source, std::vector<DxfPiece> pieces);

}  // namespace dymsum::io
