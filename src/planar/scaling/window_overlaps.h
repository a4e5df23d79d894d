// Segments that lie along each other, the same way, at every scale: where several cover a place, one goes on and the
// others stop there.
#pragma once

#include <array>
#include "base/scratch.h"
#include "planar/scaling/always_on.h"

namespace dymsum::planar {

using PiecePairs = Array<std::array<std::uint32_t, 2>>;

/// Settles the pairs of pieces that lie along each other; what stays open stays in `close`. What stops counting still
/// has to be known where something touches at one scale.
void share_lines(Window& window, AlwaysOn& always_on, PiecePairs& close);

}  // namespace dymsum::planar
