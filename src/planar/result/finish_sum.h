// The last step of every planar sum: from what an engine found to the canonical result.
#pragma once

#include "planar/result/sum_state.h"

namespace dymsum::planar {

/// Canonical order, parts, tight features, lower-dimensional pieces.
PlanarSum finish_sum(SumState&& state, const SumOptions& options);

}  // namespace dymsum::planar
