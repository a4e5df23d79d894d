// What a sum of solids went through, for pictures.
#pragma once

#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

SpatialTrace trace_of(const SolidBoundary& boundary);

}  // namespace dymsum::spatial
