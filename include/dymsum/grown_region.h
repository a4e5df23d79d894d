// A region with a margin around it: what keeps out of the grown region keeps a distance from the region itself.
#pragma once

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

struct GrownRegion {
  Region region;
  double margin = 0;   ///< every point within this distance of the given region lies inside
  double at_most = 0;  ///< no point is farther from the given region than this
};

/// The sum with a regular polygon of `sides` around the disc of radius `margin`, rounded to doubles: a little too
/// large, so that rounding loses nothing. A path of a grown robot keeps the margin in every point. It is conservative:
/// that the grown robot has no path says that none keeps the distance `at_most`, which is margin / cos(pi / sides) and
/// roundings, 2 % more than the margin for 16 sides. A margin of 0 changes nothing.
/// Errors: out_of_range for a margin that is no number, negative or beyond 2^400, or for fewer than 3 or more than 4096
/// sides; as minkowski_sum; rounding_changed_topology.
Result<GrownRegion> grown(const Region& region, double margin, int sides = 16);

}  // namespace dymsum
