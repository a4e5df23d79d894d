// What a solid sum will take.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// Arrays per facet of the reduced convolution, at the peak, of sums whose facets meet about seven others each,
/// as `./run bench solid` measures them; those that meet more take more.
inline constexpr double kBytesPerFacet = 1800;

/// Statement: dymsum/spatial_sum.h, predict_cost.
SpatialCost predicted_cost(const SolidOperand& p, const SolidOperand& q);

}  // namespace dymsum::spatial
