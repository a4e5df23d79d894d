// What a closing keeps of polylines and points: where no disc is cut off on either side of them, they stay as thin as
// they are.
#pragma once

#include "shape/disc/headings.h"

namespace dymsum::shape {

/// One boundary ring between the discs, on the right, and what they do not reach.
struct DiscBoundary {
  std::vector<DiscPiece> pieces;
  Headings headings;
  std::vector<std::uint32_t> sites;     ///< piece -> the site where it begins, if at a contact
  std::vector<std::uint32_t> touching;  ///< sites that its runs begin on and its arcs touch
  std::uint32_t edge = kNoIndex;        ///< of the complex, beyond the level; none about a convex region
};

/// Whether a segment of a polyline, or a point by itself, is among the sites.
bool has_thin_walks(const Complex& complex);

struct ThinPieces {
  std::vector<DiscBoundary> rings;    ///< with area beside every piece; nothing is said of `touching` and `edge`
  std::vector<DiscSegment> segments;  ///< maximal
  std::vector<DiscCorner> points;
};

/// Takes the pieces of rings apart that run along one another, there and back: they are the thin pieces of the set, and
/// without them the rings go on as the faces of a plane graph do where an edge is deleted. Exact.
ThinPieces without_thin_pieces(const DiscPositions& positions, const std::vector<DiscBoundary>& rings);

}  // namespace dymsum::shape
