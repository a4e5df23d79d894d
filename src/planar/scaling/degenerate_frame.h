// A frame at which something touches: the static engine's arrangement and vertex routine on the window's segments and
// pairs.
#pragma once

#include "planar/scaling/frame_place.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

/// The boundary and its tight features at a scale that the window covers. Cost: O(pieces + candidates), and the vertex
/// routine.
SumState degenerate_frame(const Window& window, const ReducedConvolution& convolution, FramePlace& place,
                          Semantics semantics);

}  // namespace dymsum::planar
