// Inner fits as sums of a complement in a frame: what erosions by a region, and by a turned one, have in common.
#pragma once

#include <optional>

#include "planar/result/sum_state.h"

namespace dymsum::planar {

/// Why P cannot be eroded by Q, or by Q turned.
std::optional<Error> not_erodible(const Region& p, const Region& q);

/// How the sum of complement_of(P, Q) and -Q is to be computed for an erosion with `options`.
SumOptions options_inside(const SumOptions& options);

/// The erosion, of that sum.
PlanarSum inside_of_frame(SumState&& state, const SumOptions& options);

}  // namespace dymsum::planar
