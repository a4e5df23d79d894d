// The obstacle of all orientations of two convex polygons: nothing happens but edges becoming parallel.
#pragma once

#include "cspace/boundary/obstacle_state.h"

namespace dymsum::planar {

/// Whether both operands of the state's base are one convex part without holes.
bool is_convex_pair(const planar::ObstacleState& state);

/// Fills a state whose regions and base are set. Theta(mn) patches, four for each of the mn alignments of an edge of
/// the robot with one of the obstacle where these have distinct angles; O(mn log mn) for sorting the angles exactly.
/// Errors: cancelled. Source: Behar 2016, section 4.3.1.
Result<void> convex_obstacle(planar::ObstacleState& state, const ObstacleOptions& options);

}  // namespace dymsum::planar
