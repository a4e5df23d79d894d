// Rings of any doubles made a valid region: snap rounding, repeated until nothing crosses.
#pragma once

#include <cstddef>

#include "dymsum/region.h"

namespace dymsum::planar {

struct SnappedRings {
  RegionData data;                  ///< valid (Region::create), rings simple
  std::size_t collapsed_edges = 0;  ///< edges of rings and polylines whose ends are one double each
  std::size_t bends = 0;   ///< places where edges were cut: crossings at their nearest doubles, vertices on them
  std::size_t lines = 0;   ///< polylines of `data` that were boundary with the set on neither side
  std::size_t points = 0;  ///< points of `data` that were rings or polylines
  std::size_t vanished_rings = 0;  ///< rings of which nothing is left: gaps that closed, parts within others
  double moved = 0;                ///< no point of an edge is further than this from what became of it
};

/// The set where the winding number of the rings is positive, of the boundary as it is after this: while two edges
/// cross, both are cut at the nearest doubles of the crossing, and an edge with a vertex on it is cut there. Every cut
/// lies in the box of its edge and is none of its ends, so that boxes get smaller and this ends. Pieces that are
/// nowhere beside the set are its thin parts, kept as polylines, as are rings of one point as points; pieces with the
/// set on both sides are no boundary any more. As the curves are moved by `moved` at most, so is the set (Hausdorff):
/// a point whose winding number changes was passed by a curve. Polylines and points are kept, each once, and not cut.
/// Exact. Requires finite coordinates. Cost: O(n log n + m) for n pieces and m pairs with overlapping x ranges, a few
/// times.
SnappedRings snapped_rings(const RegionData& data);

}  // namespace dymsum::planar
