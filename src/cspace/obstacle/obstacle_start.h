// What every obstacle begins with: its operands and their lattice.
#pragma once

#include <memory>

#include "cspace/boundary/obstacle_state.h"

namespace dymsum::planar {

/// A state with robot, obstacle and base, and nothing else. Errors as CspaceObstacle::create.
Result<std::unique_ptr<planar::ObstacleState>> start_obstacle(const Region& robot, const Region& obstacle);

}  // namespace dymsum::planar
