// The reduced engine: convolution, mask, arrangement, loops, as in the outline of docs/design/planar-sum.md.
#pragma once

#include "base/poll.h"
#include "planar/mask/refine.h"
#include "planar/result/sum_state.h"

namespace dymsum::planar {

/// Fills state.boundary, by all steps (Engine::fast), or without mask and refinement and with all pairs
/// (Engine::brute).
void run_reduced(const SumOptions& options, SumState& state, Refine refine, Poll& poll);

}  // namespace dymsum::planar
