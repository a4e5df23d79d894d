// The scales at which a place on a piece's line lies inside the piece, as far as doubles know them.
#pragma once

#include "planar/scaling/window.h"

namespace dymsum::planar {

/// Narrows a candidate's brackets to the scales at which the place t, known up to `error`, lies inside a piece. False
/// where there are none for certain. `unsure`: at its head or tail throughout the window, as far as doubles tell.
bool narrow_to_piece(const Window& window, std::uint32_t piece, const Linear& t, double error, Candidate& c,
                     std::array<bool, 2>& unsure);

}  // namespace dymsum::planar
