// Sums of solids, convex or not, given by plain lists.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/gauss/overlay.h"
#include "spatial/sum/sum_source.h"

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
/// The same, of lists some of whose faces are thin parts; none where a list of these is empty.
Result<SpatialSum> sum_of_sets(const MeshData& p, const std::vector<bool>& thin_p, const MeshData& q,
                               const std::vector<bool>& thin_q, const SpatialOptions& options);
/// The same, of meshes that may have thin parts.
Result<SpatialSum> sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options);

/// Whether positions, by the space's own numbers, lie in the sum of two operands, as contains_each determines it.
Result<std::vector<bool>> positions_in_sum(SumSpace& space, const SolidOperand& p, const SolidOperand& q,
                                           std::span<const ExactPosition> positions, Semantics semantics,
                                           const Progress& progress);

Result<SpatialSum> sum_of_operands(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options);

}  // namespace dymsum::spatial
