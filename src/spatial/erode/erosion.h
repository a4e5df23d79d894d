// The inner fit of solids given by plain lists.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

/// The inner fit that erode makes, for surfaces that sum_of_solids takes.
Result<SpatialSum> erosion(const MeshData& a, const MeshData& b, const SpatialOptions& options);
/// The same where vertices of `a`, or of both, are fractions.
Result<SpatialSum> erosion(const ExactSet& a, const MeshData& b, const SpatialOptions& options);
Result<SpatialSum> erosion(const ExactSet& a, const ExactSet& b, const SpatialOptions& options);

}  // namespace dymsum::spatial
