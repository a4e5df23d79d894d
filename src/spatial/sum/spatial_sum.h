// Sums of solids, convex or not, given by plain lists.
#pragma once

#include <memory>

#include "dymsum/spatial_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

// The sum of convex solids as the value that all sums of solids are.

/// The sum whose facets an overlay of Gauss maps at these poses tells: its facets are the faces, whole and without
/// holes, and nothing is tight. O(n log n) comparisons of doubles.
SpatialSum sum_of_overlay(const Overlay& overlay, std::shared_ptr<const ConvexOperands> operands, const SolidPose& p,
                          const SolidPose& q);

/// The sum of one pair where at most `memory` bytes suffice for it beside operands and result; else the error
/// out_of_memory. 0: no limit. `p`: a mesh, or a sum as ConvexSum::create takes it.
Result<SpatialSum> small_convex_sum(const Mesh& p, const Mesh& q, std::uint64_t memory);
Result<SpatialSum> small_convex_sum(const SpatialSum& p, const Mesh& q, std::uint64_t memory);

/// The sum that minkowski_sum makes, for surfaces that also may have edges with more than two faces and vertices with
/// several fans, as long as they are closed, oriented, and cross nowhere.
Result<SpatialSum> sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options);
/// The same, of meshes that may have thin parts.
Result<SpatialSum> sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options);

Result<SpatialSum> sum_of_operands(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options);

}  // namespace dymsum::spatial
