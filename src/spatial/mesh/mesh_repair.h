// The first part of the named repair: surfaces that may still cross.
#pragma once

#include "dymsum/mesh.h"
#include "dymsum/result.h"

namespace dymsum::spatial {

struct PreparedSurface {
  MeshData data;
  MeshRepairReport report;
};

/// What repair() does before it looks at shells: vertices at one position merged, faces without area dropped,
/// T-junctions closed, faces that are not plane split, and single faces turned over that do not agree with their
/// neighbours. Errors: not_finite, bad_index.
Result<PreparedSurface> prepared_surface(MeshData data);

}  // namespace dymsum::spatial
