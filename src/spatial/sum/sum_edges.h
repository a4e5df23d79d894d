// The edges of a sum's faces.
#pragma once

#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// All edges with the faces that they bound, sorted; without contacts. O(n log n).
std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces);

}  // namespace dymsum::spatial
