// Tight features of a sum, rounded, as data of a region.
#pragma once

#include "dymsum/planar_sum.h"

namespace dymsum::io {

/// Tight segments as polylines and tight points as points, every vertex correctly rounded.
RegionData tight_data(const PlanarSum& sum);

/// The rounded set of a sum with its tight features, where they are not pieces of it anyway, behind its own polylines
/// and points: the same closed set.
RegionData closed_data(const PlanarSum& sum, const Region& rounded);

}  // namespace dymsum::io
