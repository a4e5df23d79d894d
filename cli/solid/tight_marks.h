// Points and lines as a mesh to look at.
#pragma once

#include <array>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::cli {

/// Octahedra about tight points, bars with three sides along tight segments and around tight faces: large enough to be
/// seen. Empty where nothing is tight.
MeshData tight_marks(const SpatialSum& sum);
/// Octahedra about positions, large enough to be seen beside a mesh.
MeshData position_marks(const MeshData& mesh, const std::vector<Point3>& positions);
/// Bars along segments.
MeshData bars(const std::vector<std::array<Point3, 2>>& segments, double radius);

}  // namespace dymsum::cli
