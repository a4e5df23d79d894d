// What pairs of edges that cross each other prove to be covered, along segments, where cells are too coarse.
#pragma once

#include "planar/arrangement/live_pieces.h"

namespace dymsum::planar {

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
