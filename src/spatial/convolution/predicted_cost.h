// What a solid sum will take.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// Arrays per facet of the reduced convolution, at the peak, of sums whose facets meet about seven others each,
/// as `./run bench solid` measures them, with kPairsPerFacet pairs of boxes that overlap for each; further pairs take
/// kBytesPerPair each, as sums of combs with themselves measure: a fifth of them meet.
inline constexpr double kBytesPerFacet = 1800, kPairsPerFacet = 15, kBytesPerPair = 25;

/// Statement: dymsum/spatial_sum.h, predict_cost.
SpatialCost predicted_cost(const SolidOperand& p, const SolidOperand& q);

}  // namespace dymsum::spatial
