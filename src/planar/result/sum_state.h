// A planar sum in the making: what its stages hand on.
#pragma once

#include <memory>

#include "dymsum/planar_sum.h"
#include "planar/boundary/raw_boundary.h"
#include "planar/operand/operand.h"
#include "planar/operand/placed_pair.h"

namespace dymsum::planar {

struct SumState : PlacedPair {
  SumState() = default;
  explicit SumState(PlacedPair placed) : PlacedPair(std::move(placed)) { stats.tier_bits = lattice->tier_bits; }

  RawBoundary boundary;
  SumStats stats;
  std::unique_ptr<PlanarTrace> trace;  ///< where one is to be recorded
};

/// Whether stages are timed: of small sums they are not.
inline bool timed(const SumState& state) { return state.p->size() + state.q->size() > 100; }

}  // namespace dymsum::planar
