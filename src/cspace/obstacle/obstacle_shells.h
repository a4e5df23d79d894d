// The patches that are one surface, whether free space beyond it reaches infinity, and Euler numbers.
// docs/design/cspace-obstacle.md, "Euler numbers".
#pragma once

#include <vector>

#include "cspace/boundary/obstacle_state.h"
#include "cspace/obstacle/swept_boundary.h"

namespace dymsum::planar {

/// Adds shells to a state that has patches and cells. `node_of`: of every patch, a node.
void add_shells(const SweptBoundary& swept, const std::vector<std::uint32_t>& node_of, planar::ObstacleState& state);

}  // namespace dymsum::planar
