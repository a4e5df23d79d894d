// The sum of solids given by plain lists, and that of convex solids as one of any solids.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// As minkowski_sum, for surfaces that also may have edges with more than two faces and vertices with several fans, as
/// long as they are closed, oriented, and cross nowhere.
Result<SpatialSum> sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options);
/// The same, of meshes that may have thin parts.
Result<SpatialSum> sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options);

Result<SpatialSum> sum_of_operands(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options);

/// convex_sum(p, q) where at most `memory` bytes suffice for it and for boundary_of, beside operands and result; else
/// the error out_of_memory. 0: no limit.
Result<SolidSum> small_convex_sum(const Mesh& p, const Mesh& q, std::uint64_t memory);

/// The same set as a SpatialSum. Faces keep the features that the convex sum names. O(n log n) exact comparisons.
SpatialSum boundary_of(const SolidSum& convex);

}  // namespace dymsum::spatial
