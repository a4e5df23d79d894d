// Regions whose rings touch, rewritten so that the engine's local view holds: at every visit of a vertex the wedge on
// the left is one whole sector of the region, and components have connected interiors.
#pragma once

#include <vector>

#include "planar/region/engine_region.h"

namespace dymsum::planar {

/// The same set. Without touching points: the data as they are, borrowed. Otherwise edges are cut at touching points,
/// every way in is joined to the next way out clockwise, and rings are grouped anew; they may then visit a point
/// several times.
EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points);

}  // namespace dymsum::planar
