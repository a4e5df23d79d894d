// Parts of an operand without volume: points, segments, polylines, plane polygons and open surfaces.
//
// A plate, one triangle of a surface, has two faces: its front and its back. An edge of plates supports the planes that
// have all of them on one side: as a wedge of material between the two outermost ones would, the plate itself where
// there is one. A segment by itself supports every plane through it, a vertex every plane that has all that begins
// there on one side.
#pragma once

#include <vector>

#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// Adds the faces that `thin` marks: with one vertex points, with two segments, else plates. Requires plates that are
/// valid by themselves; all parts may cross each other and the solid. Exact. O(n log n) for bounded degrees, O(k^2) at
/// an edge with k plates and a vertex with k edges.
void add_thin_parts(SolidOperand& operand, const OperandSigns& signs, const MeshData& data,
                    const std::vector<bool>& thin);

}  // namespace dymsum::spatial
