// What frames of a scaling sum cost, in about microseconds, by what they looked at. Unlike time it is the same in every
// run and whatever else the machine does, so that every run makes the same choices. Fitted to frames of the pairs of
// `./run bench scaling`.
#pragma once

#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

/// A frame from scratch, or the part of a degenerate frame that goes through the static engine's arrangement.
double cost_of_sum(const PlanarSum& sum);
/// A window, without its first frame. `all`: segments of the convolution.
double cost_of_window(const Window& window, std::uint32_t all);
/// How many boxes of pieces may meet in one that costs no more.
std::uint64_t pairs_of_window(double cost, std::uint32_t all);
/// A frame inside a window.
double cost_of_frame(const FrameWork& work, const PlanarSum& sum);

}  // namespace dymsum::planar
