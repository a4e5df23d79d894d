// The winding engine: an independent way to the boundary, through the kinetic convolution and winding numbers.
#pragma once

#include "base/poll.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

/// Fills state.boundary.
void run_winding(const SumOptions& options, SumState& state, Poll& poll);

}  // namespace dymsum::planar
