// A frame at which something touches: the static engine on the window's segments and pairs.
#pragma once

#include "planar/scaling/exact_frame.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

/// The sum at a scale that the window covers. Cost: O(pieces + candidates), and the vertex routine.
PlanarSum degenerate_frame(const Window& window, const ReducedConvolution& convolution, ExactFrame& frame,
                           Semantics semantics);

}  // namespace dymsum::planar
