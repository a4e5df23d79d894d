// The worst case of planar sums: two polygons of n corners whose sum has on the order of n^4 holes.
#pragma once

#include <utility>

#include "dymsum/region.h"

namespace dymsum::bench {

/// Two L-shaped polygons, each with n upright and n lying bars. The upright bars add up to n^2 upright bars, the lying
/// ones to n^2 lying bars, and both meet in one square, which closes n^4 holes. Everything else of the sum stays beside
/// that square.
std::pair<Region, Region> crossing_grates(int n);

}  // namespace dymsum::bench
