// What a sum of solids went through, for pictures.
#pragma once

#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

/// Throws OverBudget.
SpatialTrace trace_of(const SolidBoundary& boundary, StageWatch& watch);

}  // namespace dymsum::spatial
