// The sum of solids given by plain lists.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// The sum that minkowski_sum makes, for surfaces that also may have edges with more than two faces and vertices with
/// several fans, as long as they are closed, oriented, and cross nowhere.
Result<SpatialSum> sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options);
/// The same, of meshes that may have thin parts.
Result<SpatialSum> sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options);

Result<SpatialSum> sum_of_operands(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options);

}  // namespace dymsum::spatial
