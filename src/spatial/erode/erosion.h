// The inner fit of solids given by plain lists.
#pragma once

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// As erode, for surfaces that sum_of_solids takes.
Result<SpatialSum> erosion(const MeshData& a, const MeshData& b, const SpatialOptions& options);

}  // namespace dymsum::spatial
