// The natural length per radian of a region that turns.
#pragma once

#include "dymsum/region.h"

namespace dymsum::apps {

/// The root of the mean square distance of the region's points from the origin, within 2^-50 of itself, also for
/// regions so thin that their area is lost to rounding. Requires: its parts are not empty. O(n) operations with
/// integers as long as its coordinates together.
double radius_of_gyration(const Region& region);

}  // namespace dymsum::apps
