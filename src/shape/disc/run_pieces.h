// The pieces of boundary that a run of positions makes at a level.
#pragma once

#include "shape/disc/level_rings.h"
#include "shape/disc/thin_pieces.h"

namespace dymsum::shape {

/// Pieces in the order of the walk with their directions, and where the last one ends.
struct Pieces {
  std::vector<DiscPiece> list;
  Headings headings;
  DiscCorner end;
};

/// The positions moved by the radius: segments, and arcs about vertices, counter-clockwise. Requires radius > 0.
void append_moved(const DiscPositions& positions, const BoundaryOrder& order, const Run& run, Pieces& pieces);

/// The places themselves: parts of edges between where the discs at both ends of the run touch. Pieces without length
/// are left out, and so is a run that is a vertex alone. Requires radius > 0.
void append_in_place(const DiscPositions& positions, const BoundaryOrder& order, const Run& run, Pieces& pieces);

/// The direction of a boundary where a disc touches a site: along an edge, or square to what leads from a vertex.
Heading heading_at_contact(const DiscPositions& positions, const CornerDisc& disc, std::uint32_t site);

/// The corner where a disc touches a site.
DiscCorner contact_corner(const DiscPositions& positions, const CornerDisc& disc, std::uint32_t site);

/// The turn from one direction to another, clockwise or not, in [0, 2 pi): what rounds to just below 0 is 0 where at
/// most `most` + pi / 4 can be, else beyond it.
double turn_between(double from_angle, double to_angle, double most);

}  // namespace dymsum::shape
