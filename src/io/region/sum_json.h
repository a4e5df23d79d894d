// Tight features of a sum, rounded, as data of a region.
#pragma once

#include "dymsum/planar_sum.h"

namespace dymsum::io {

/// Tight segments as polylines and tight points as points, every vertex correctly rounded.
RegionData tight_data(const PlanarSum& sum);

/// A set with its tight features, where they are not pieces of it anyway, behind its own polylines and points: the same
/// closed set.
RegionData with_tight(RegionData set, const RegionData& tight);

}  // namespace dymsum::io
