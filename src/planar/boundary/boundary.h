// What leads from the arrangement to the boundary: loops, which of them are true, and rings with interior on the left.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/poll.h"
#include "dymsum/planar_sum.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/crossings.h"
#include "planar/boundary/collision.h"
#include "planar/mask/fine_cells.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

// What an engine finds, before canonical output.

struct RawBoundary {
  std::vector<SumRing> rings;        ///< interior on the left
  std::vector<std::uint8_t> outer;   ///< per ring: counter-clockwise
  std::vector<SumSegment> cracks;    ///< closed sub-edges of tight segments, not merged
  std::vector<SumVertex> punctures;  ///< candidates that are not on cracks are tight points
  double at_error = 0;               ///< |at - exact| in input coordinates
  bool may_touch = true;             ///< rings may touch one another

  void add(SumRing ring, bool counter_clockwise) {
    rings.push_back(std::move(ring));
    outer.push_back(counter_clockwise);
  }
};

// The outer boundary among loops, by how far left they reach.

/// The one of n loops that do not turn clockwise that provably reaches farthest left, or n where doubles do not decide:
/// of a connected sum its outer boundary. for_each_end(i, f) calls f(x, error) for the vertices of loop i.
template <class Clockwise, class ForEachEnd>
std::size_t leftmost_loop(std::size_t n, const Clockwise& clockwise, const ForEachEnd& for_each_end) {
  // The least x of loop i lies within 2 error of low, the difference x - e errs by a rounding of x, which positions err
  // by, too, and the difference below by as much.
  constexpr double kApart = 4;
  double best = INFINITY, second = INFINITY, error = 0;
  std::size_t leftmost = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (clockwise(i)) continue;
    double low = INFINITY;
    for_each_end(i, [&](double x, double e) {
      low = std::min(low, x - e);
      error = std::max(error, e);
    });
    if (low < best) {
      second = best;
      best = low;
      leftmost = i;
    } else {
      second = std::min(second, low);
    }
  }
  return second - best > kApart * error ? leftmost : n;
}

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

// Tight features: places outside the open sum that nothing outside it surrounds. docs/design/planar-sum.md, "Tight
// features".

/// Appends the cracks and punctures of an arrangement; `kept` are its true loops. Grows `grid_error` to the largest
/// error of a position.
void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error, const Poll* poll = nullptr);

}  // namespace dymsum::planar
