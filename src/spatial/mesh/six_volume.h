// Exact volumes of shells.
#pragma once

#include <vector>

#include "dymsum/mesh.h"
#include "exact/big.h"
#include "spatial/mesh/half_edges.h"

namespace dymsum::spatial {

/// The sign of the volume that each shell encloses: -1 for a shell that is inside out. Requires plane faces and closed
/// shells. Exact. O(n).
std::vector<int> shell_signs(const MeshData& data, const Shells& shells);

/// The exact volume of all shells together.
exact::BigRational exact_volume(const MeshData& data);

}  // namespace dymsum::spatial
