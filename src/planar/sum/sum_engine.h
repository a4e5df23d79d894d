// The engine that makes the boundary of a planar sum, and what becomes of its failures.
#pragma once

#include "planar/mask/refine.h"
#include "planar/result/sum_state.h"

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

}  // namespace dymsum::planar
