// Sizes of the complete and the reduced convolution and their crossings, as table 4.2 lists them.
#pragma once

#include <cstdint>

#include "dymsum/region.h"

namespace dymsum::bench {

struct ConvolutionCounts {
  std::uint64_t complete = 0, complete_crossings = 0, reduced = 0, reduced_crossings = 0;
  std::uint64_t live_crossings = 0;  ///< those our engine computes: segments inside the interior mask take no part
  std::uint64_t misjudged = 0;       ///< segments more or less that doubles find, where edges are nearly parallel
};

/// P (+) Q at the orientation of the operands. The sizes are those of convolution_sizes. Crossings are proper ones,
/// found by testing all pairs whose boxes overlap with signs in doubles: common endpoints do not count, nearly touching
/// segments may be miscounted.
ConvolutionCounts count_convolutions(const Region& p, const Region& q);

}  // namespace dymsum::bench
