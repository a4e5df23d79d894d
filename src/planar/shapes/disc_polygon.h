// Polygons that hold a disc, for distances that have to be kept.
#pragma once

#include <optional>

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::planar {

/// A polygon of 32 sides about the origin that holds the disc of this radius and lies in that of a radius 1 % larger,
/// symmetric to both axes. Its coordinates have at most 14 bits over a power of two. Errors: out_of_range for a radius
/// that is not from 2^-900 to 2^400, with `what` it is.
Result<Region> polygon_around_disc(double radius, const char* what);
/// The same for a distance that may be 0: nothing then.
Result<std::optional<Region>> polygon_of_distance(double distance, const char* what);

}  // namespace dymsum::planar
