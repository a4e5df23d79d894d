// The obstacle of all orientations of regions of any shape.
#pragma once

#include "planar/rotation/obstacle_state.h"

namespace dymsum::planar {

/// Fills a state whose regions and base are set. Errors: cancelled.
Result<bool> general_obstacle(CspaceObstacle::State& state, const ObstacleOptions& options);

}  // namespace dymsum::planar
