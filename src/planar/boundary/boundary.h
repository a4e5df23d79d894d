// What leads from the arrangement to the boundary: loops, which of them are true, and rings with interior on the left.
#pragma once

#include <cstdint>
#include <vector>

#include "base/poll.h"
#include "dymsum/planar_sum.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/soup.h"
#include "planar/boundary/collision.h"
#include "planar/mask/fine_cells.h"
#include "planar/operand/contact_of.h"

namespace dymsum::planar {

using Step = Arrangement::Step;

/// A cycle of the successor map; the set's outside is on its right.
struct BoundaryLoop {
  Array<Step> steps;
  int turning = 0;  ///< 1 counter-clockwise, -1 clockwise
};

/// How often the direction passes +x counter-clockwise: +1 or -1 for a loop that bounds one face.
int turning_number(const Soup& soup, const Array<Step>& steps);

/// All cycles.
Array<BoundaryLoop> find_loops(const Soup& soup, const Arrangement& arrangement, const Poll* poll = nullptr);

/// Splits loops into true and false ones. With `connected`, the sum has one outer boundary, which needs no test; nor do
/// loops that pass covered cells.
struct SortedLoops {
  Array<BoundaryLoop> kept, dropped;
};
SortedLoops verify_loops(const Soup& soup, const Arrangement& arrangement, Array<BoundaryLoop> loops,
                         Collision& collision, bool connected, const KnownCover& cover = {},
                         const Poll* poll = nullptr);

/// Loops that meet themselves or each other at nodes are cut there so that every ring is simple and bounds a connected
/// interior.
Array<BoundaryLoop> simple_rings(const Soup& soup, const Arrangement& arrangement, Array<BoundaryLoop> loops);

/// Provenance.
inline Contact contact_of(const Soup& soup, std::uint32_t segment) {
  const SoupSegment& g = soup.segments[segment];
  return contact_of(WalkSegment{g.side(), g.edge(), g.vertex}, *soup.operands[0], *soup.operands[1]);
}
SumVertex vertex_of(const Soup& soup, std::uint32_t in, std::uint32_t out, const SubEnd& end,
                    const SegmentPosition& position);

/// The ring of a loop with collinear steps merged; grows `error` to the largest error of a position, in input
/// coordinates.
SumRing make_ring(const Soup& soup, const Arrangement& arrangement, const BoundaryLoop& loop, double& error);

/// The error of the position that vertex_of gives to a position, in grid units.
double position_error(const Soup& soup, const SegmentPosition& position);

/// A bound on the error of rounding to input coordinates, and of a rounded position there.
double rounding_error(const Lattice& lattice);
double input_error(const Lattice& lattice, double grid_error);

}  // namespace dymsum::planar
