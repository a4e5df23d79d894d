// The winding engine: an independent way to the boundary, through the kinetic convolution and winding numbers.
#pragma once

#include "planar/sum/sum_engine.h"

namespace dymsum::planar {

/// Fills state.boundary. Returns false when stopped by the progress callback.
bool run_winding(const SumOptions& options, SumState& state);

}  // namespace dymsum::planar
