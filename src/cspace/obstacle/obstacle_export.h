// What a sweep found, as the obstacle's patches, cells, shells, angles and events.
#pragma once

#include "cspace/boundary/obstacle_state.h"
#include "cspace/obstacle/swept_boundary.h"

namespace dymsum::planar {

/// Fills a state that has its operands and base, which may name contacts differently from the sweep's. Requires that
/// the sweep is closed.
void export_obstacle(const SweptBoundary& swept, const TurningForms& forms, planar::ObstacleState& state);

}  // namespace dymsum::planar
