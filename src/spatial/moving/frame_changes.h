// What became of the faces of a sum from one frame to the next.
#pragma once

#include "dymsum/moving_solid_sum.h"

namespace dymsum::spatial {

SolidFrameChanges frame_changes(const SpatialSum& before, const SpatialSum& after);

}  // namespace dymsum::spatial
