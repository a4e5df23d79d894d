// The sum of solids given by plain lists.
#pragma once

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// As spatial_sum, for surfaces that also may have edges with more than two faces and vertices with several fans, as
/// long as they are closed, oriented, and cross nowhere.
Result<SpatialSum> sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options);

}  // namespace dymsum::spatial
