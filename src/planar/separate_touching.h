// Regions whose rings touch, rewritten so that the engine's local view holds: at every visit of a vertex the wedge on the left is one
// whole sector of the region, and components have connected interiors.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::planar {

/// Region data for the engine, with the numbers its vertices and edges have in the region they come from.
struct EngineRegion {
  RegionData data;
  std::vector<std::uint32_t> vertex_number, edge_number;
};

/// The same set. Without touching points: the data as they are. Otherwise edges are cut at touching points, every way in is joined
/// to the next way out clockwise, and rings are grouped anew; they may then visit a point several times.
EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points);

}  // namespace dymsum::planar
