// Polygons of which parts of the boundary are nearer to each other than their vertices are known.
#pragma once

#include <cstddef>

#include "dymsum/region.h"

namespace dymsum::shape {

struct MergedPolygons {
  RegionData data;
  std::size_t merged = 0;  ///< intervals of boundary along which two sides are one, and rings that are one point
  double moved = 0;        ///< no point of the boundary is further than this from what it was
};

/// Vertices within `near` of each other in both coordinates are one, and a vertex within `near` of an edge is on it.
/// Where two edges are then one, there and back, the set is as thin as that, and has a polyline there, or what is
/// beside it is, and both go; the other edges go on as the faces of a plane graph do where an edge is deleted. Holes
/// lie in the innermost ring around them. Nothing here is exact: Region::create judges. O(n log n) for rings of short
/// edges.
MergedPolygons merged_polygons(const RegionData& data, double near);

}  // namespace dymsum::shape
