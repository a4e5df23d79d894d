// Planar sums: the engine that makes the boundary, and what becomes of its failures; sums from scratch of operands
// that are placed, and of candidates that are known.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "planar/mask/fine_cells.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

/// Both operands in the units of their common grid. Error unsupported_operand for coordinates beyond 2^1000.
Result<SumState> placed_state(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q, int min_tier_bits);

/// Operands (P as operand 0, Q as 1) on their lattice, then the boundary by the chosen engine. Errors: as
/// minkowski_sum; with stage and counts, out_of_memory where memory does not suffice and unsupported_operand where
/// 32-bit indices do not.
Result<SumState> compute_boundary(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                                  const SumOptions& options, Refine refine = Refine::where_it_pays);

/// The same for operands that are already on a lattice.
Result<SumState> compute_boundary(PlacedPair placed, const SumOptions& options);

// Sums of operands that stand on a common lattice: the doors through which moving sums use the static engine.

class Collision;
class ReducedConvolution;

/// The sum from scratch. Errors: as minkowski_sum.
Result<PlanarSum> placed_sum(PlacedPair placed, const SumOptions& options);

/// What is known of a sum's boundary before it is computed: the segments of the reduced convolution that can bound it,
/// and the pairs among them that can meet.
struct BoundaryCandidates {
  /// A point of a segment that lies in the open sum: what reaches it is no boundary.
  struct Covered {
    std::uint32_t segment = 0;
    double fraction = 0;  ///< of the segment's length
  };
  const ReducedConvolution& convolution;
  std::vector<WalkSegment> segments;                ///< in the order of their ids in the convolution
  std::span<const std::uint32_t> segment_of;        ///< id in the convolution -> index of the segment, or ~0
  std::vector<std::array<std::uint32_t, 2>> pairs;  ///< of segments, a < b, sorted, each once
  std::vector<Covered> covered;
  bool connected = false;  ///< one component each
};
struct CandidateSum {
  PlanarSum sum;
  std::uint64_t exact_signs = 0;  ///< that doubles did not decide, without those of collision tests
};
/// The sum with its tight features, from what can bound it. `collision` tests operands of `placed`. Cost: O(segments +
/// pairs), and the vertex routine.
CandidateSum sum_of_candidates(PlacedPair placed, const BoundaryCandidates& candidates, Collision& collision,
                               Semantics semantics);

// What an operation takes, as the engine sees it.

/// A region as it is kept prepared, a result as region_of_result; or its reflection.
std::shared_ptr<const Operand> taken_operand(const PlanarOperand& operand, std::uint32_t op, bool reflected = false);

// The boundary of the sum of two convex operands: nothing has to be intersected.

/// The boundary of P + Q when both operands are one component with a convex outer loop whose holes the other one fills:
/// the outer edges of both in the order of their directions, interior on the left. Nothing for other operands. O(n + m)
/// for n and m edges, of which equal or nearly equal directions are compared exactly.
std::optional<SumRing> convex_boundary(const Lattice& lattice, const Operand& p, const Operand& q);

}  // namespace dymsum::planar
