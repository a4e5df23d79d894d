// Sums of operands that stand on a common lattice: the doors through which moving sums use the static engine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/operand/operand.h"
#include "planar/operand/placed_pair.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
