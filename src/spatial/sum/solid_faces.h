// Cells put together to the faces, vertices and tight features of a result.
#pragma once

#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

/// Fills vertices, faces, shells and tight features, in canonical order; the sum keeps the boundary's space for its
/// exact positions. `p` and `q` give the faces and edges of the
/// operands' meshes.
void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch);

}  // namespace dymsum::spatial
