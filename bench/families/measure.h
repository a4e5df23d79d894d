// A family against sums from scratch at the same scales: what making it costs, and what a query costs then.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/scale.h"
#include "scaling/pairs.h"
#include "spread.h"

namespace dymsum::bench {

/// Processor times in milliseconds, of one thread.
struct FamilyRow {
  std::string name, interval;
  std::uint64_t events = 0, visible = 0, names = 0, bytes = 0, vertices = 0;
  double making_ms = 0, scratch_ms = 0;  ///< of the family; all pairs from scratch, mean of a few scales
  Spread at_ms, static_ms;               ///< of a query, and of the sum from scratch at the same scale
  double least = 0;                      ///< the least ratio of both at one scale
  std::size_t compared = 0, different = 0;
};

struct FamilyPlan {
  Scale low, high;
  std::vector<Scale> scales;  ///< of the queries
  std::size_t all_pairs = 0;  ///< scales at which the thesis's baseline is measured too
};

/// Seeded random scales of an interval with 12 fractional bits, evenly spread or in tenths as those of table 6.1.
std::vector<Scale> scales_in(double low, double high, std::size_t count);
std::vector<Scale> tenths(std::size_t count);

FamilyRow measure_family(const ScalingPair& pair, const FamilyPlan& plan);
/// The family of a whole turn of P, queried at so many seeded orientations.
FamilyRow measure_turn(const ScalingPair& pair, std::size_t count);

}  // namespace dymsum::bench
