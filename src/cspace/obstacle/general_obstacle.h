// The obstacle of any two regions: windows of angles, their events, and the sweep over them.
#pragma once

#include "cspace/boundary/obstacle_state.h"

namespace dymsum::planar {

/// Fills everything but robot, obstacle and base, which are set. Errors: cancelled; unsupported_operand for
/// regions that touch themselves.
Result<void> general_obstacle(planar::ObstacleState& state, const ObstacleOptions& options);

}  // namespace dymsum::planar
