// Polygons on one side of a disc, for tolerances: nothing is lost, and parallel to the axes nothing is added.
#pragma once

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::uncertain {

/// A polygon of `sides` about the origin that holds the disc, or that lies in it, symmetric to both axes and to their
/// bisectors. It reaches as far along the axes as the disc does, exactly.
Region polygon_around(double radius, int sides);
Region polygon_inside(double radius, int sides);
/// The one lies in the disc of radius + this, the other one holds that of radius - this.
double polygon_error(double radius, int sides);

/// out_of_range for a radius that is not from 2^-900 to 2^400, or 0, and for sides that are no multiple of 4 from 4 to
/// 256.
Result<void> check_disc(double radius, int sides);

}  // namespace dymsum::uncertain
