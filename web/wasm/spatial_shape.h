// What sums of solids look like to JavaScript.
#pragma once

#include "bind.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::web {

/// SpatialShape of index.d.ts.
val spatial_shape(const SpatialSum& sum);

}  // namespace dymsum::web
