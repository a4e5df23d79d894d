// The solids that surfaces bound which cross, touch or lie on each other: by winding number, exactly. So the union of
// solids that overlap, and the other Boolean operations.
#pragma once

#include <span>

#include "dymsum/fill.h"
#include "dymsum/mesh.h"
#include "dymsum/named_repairs.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The closure of the interior of all positions inside, whatever the faces of `surface` cross, touch, or lie on. All
/// faces together have to be closed surfaces, as sets: edges need not have equal vertices on their two sides, and
/// vertices at one position are one. Faces that are not plane count as their triangles. Faces without area, and points
/// and segments, are left out. The result is that of minkowski_sum with the origin: exact, canonical, without tight
/// features; `p` of every face and contact are features of `surface`, with its indices, `q` is vertex 0. It is empty
/// where nothing is inside. Of the options threads, memory and progress count.
/// Errors: not_finite; bad_index; not_closed with a position on an edge around which the faces do not close; cancelled;
/// out_of_memory; unsupported_operand for coordinates that need more than 8,192 bits on their common grid.
/// O(n log n + k + t log t) for n faces, k of their pairs that meet and t points where three of them do.
Result<SpatialSum> united(const MeshData& surface, Fill fill = Fill::positive, const SpatialOptions& options = {});

/// The union of any number of solids. Operands are closed sets, thin parts included, and what is taken away is open:
/// what of that lies outside of the regular part of the result, as a face in which two solids touch, is listed as
/// tight, and so is inside of it what the operation of open sets lacks (closed and open semantics, with options.tight).
/// With regular semantics parts without volume are left out, of operands and of the result. Faces name those of the
/// operands, in their order, counted on from operand to operand, and vertices likewise. Errors and cost as above; what
/// is tight takes O(log n) rationals for every cell where operands touch, and O(k (k + n)) for k thin segments and
/// points.
Result<SpatialSum> united(std::span<const Mesh> solids, const SpatialOptions& options = {});
/// What lies in both solids, in `a` alone, or in one of them alone.
Result<SpatialSum> intersection(const Mesh& a, const Mesh& b, const SpatialOptions& options = {});
Result<SpatialSum> difference(const Mesh& a, const Mesh& b, const SpatialOptions& options = {});
Result<SpatialSum> symmetric_difference(const Mesh& a, const Mesh& b, const SpatialOptions& options = {});

/// What lies in all of some solids (at least one, else out_of_range), or in `a` and in none of those `taken` away.
Result<SpatialSum> intersection(std::span<const Mesh> solids, const SpatialOptions& options = {});
Result<SpatialSum> difference(const Mesh& a, std::span<const Mesh> taken, const SpatialOptions& options = {});

/// The same of operands of either kind, unrounded. Of results triangles are named as faces, counted on likewise.
Result<SpatialSum> united(std::span<const SpatialOperand> sets, const SpatialOptions& options = {});
Result<SpatialSum> intersection(std::span<const SpatialOperand> sets, const SpatialOptions& options = {});
Result<SpatialSum> difference(const SpatialOperand& a, std::span<const SpatialOperand> taken,
                              const SpatialOptions& options = {});
Result<SpatialSum> intersection(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options = {});
Result<SpatialSum> difference(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options = {});
Result<SpatialSum> symmetric_difference(const SpatialOperand& a, const SpatialOperand& b,
                                        const SpatialOptions& options = {});

/// The named repair of surfaces that cross: what repair() repairs, it repairs. Where faces cross, touch or lie on each
/// other after that, or bound nothing where they meet, the solid that they bound by `fill` is taken (united), with its
/// vertices rounded as SpatialSum::rounded does. Vertices at one position are merged before, T-junctions closed, single
/// faces turned over that do not agree with their neighbours, and with Fill::nonzero shells that are inside out and
/// cross another one. Else shells stay as they run: one inside of another that runs the same way adds nothing, one that
/// runs the other way is a cavity. Errors: that of repair() where the union has none or nothing is inside; cancelled;
/// out_of_memory.
Result<RepairedMesh> repair_with_union(MeshData data, Fill fill = Fill::nonzero, const SpatialOptions& options = {});
/// The same with the repairs that are named alone, and with loose walls dropped.
Result<LoggedMesh> repair_with_union(MeshData data, Fill fill, const MeshRepairOptions& repairs,
                                     const SpatialOptions& options = {});

}  // namespace dymsum
