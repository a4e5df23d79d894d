// The number tier that a region's coordinates alone ask for.
#pragma once

#include "dymsum/region.h"

namespace dymsum::cli {

/// Bits of the integers that hold the region on its lossless grid: 29, 61, 512, or 0 for arbitrary precision.
int tier_of(const Region& region);

}  // namespace dymsum::cli
