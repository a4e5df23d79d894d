// An environment of scaled copies of one obstacle with a robot: figure 6.11 of the thesis, measured.
#pragma once

#include <string>
#include <vector>

#include "scaling/measure.h"

namespace dymsum::bench {

struct CopiesPlan {
  std::string sizes;           ///< for the table
  std::vector<double> scales;  ///< with at most 17 significant bits
};

/// Twelve sizes each: spread over [1/2, 2]; within 12 % of each other; four sizes, each three times.
std::vector<CopiesPlan> twelve_copies();

struct CopiesRow {
  std::string name, sizes;
  std::size_t copies = 0, distinct = 0;
  std::uint64_t segments = 0, vertices = 0, windows = 0, rebuilt = 0;
  double copies_ms = 0, static_ms = 0, all_pairs_ms = 0;  ///< medians over the rounds, for all copies together
  std::uint64_t compared = 0, different = 0;  ///< sums of copies: from the static engine's and from the baseline's
};

/// All copies by scaled_copies; each with the static engine; each with the thesis's baseline (once). The first two take
/// turns, `rounds` times. All sums are compared exactly. Requires: the pair scales P.
CopiesRow measure_copies(const ScalingPair& pair, const CopiesPlan& plan, int rounds, bool baseline);

}  // namespace dymsum::bench
