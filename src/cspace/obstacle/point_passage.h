// Passages through a point: where rings touch, a straight wire may pass between them, through a point: without
// clearance, but turning and sliding.
#pragma once

#include <optional>

#include "dymsum/region.h"

namespace dymsum::planar {

/// A touching point of a region through which straight lines of a whole range of directions pass without meeting its
/// interior on the way: they enter by one of the free sectors there and leave by another one. None where each free
/// sector lies opposite to a filled one, as where a vertex touches the midpoint of an edge. Exact. O(n) per touching
/// point.
std::optional<Point> point_passage(const Region& region);

}  // namespace dymsum::planar
