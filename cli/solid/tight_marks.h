// Tight features as a mesh to look at.
#pragma once

#include "dymsum/spatial_sum.h"

namespace dymsum::cli {

/// Octahedra about tight points, bars with three sides along tight segments and around tight faces: large enough to be
/// seen. Empty where nothing is tight.
MeshData tight_marks(const SpatialSum& sum);

}  // namespace dymsum::cli
