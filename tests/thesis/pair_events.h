// The thesis's pair events: what its sums under scaling would have to keep, counted.
#pragma once

#include <cstdint>

#include "dymsum/scaling_sum.h"

namespace dymsum {

/// The thesis's pair events (6.2.2) over s in (0, infinity), counted without storing them: for each pair of convolution
/// segments the finite ends of the interval of scales at which they meet. O(N^2) time, O(N) memory.
struct PairEventCount {
  std::uint64_t segments = 0;
  std::uint64_t pairs_that_meet = 0;  ///< pairs with a non-empty interval
  std::uint64_t events = 0;           ///< ends of these intervals strictly between 0 and infinity
  std::uint64_t exact_pairs = 0;      ///< pairs that doubles did not decide
};
Result<PairEventCount> count_pair_events(const Region& p, const Region& q, MovingOperand scaled,
                                         const Progress& progress = {});

}  // namespace dymsum
