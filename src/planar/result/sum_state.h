// A planar sum in the making: what its stages hand on.
#pragma once

#include <memory>

#include "dymsum/planar_sum.h"
#include "planar/boundary/raw_boundary.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

struct SumState {
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
  RawBoundary boundary;
  SumStats stats;
  std::unique_ptr<PlanarTrace> trace;  ///< where one is to be recorded
};

/// Whether stages are timed: of small sums they are not.
inline bool timed(const SumState& state) { return state.p->size() + state.q->size() > 100; }

}  // namespace dymsum::planar
