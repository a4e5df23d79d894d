// Inner fits as sums of a complement in a frame: what erosions by a region, and by a turned one, have in common.
#pragma once

#include <optional>

#include "planar/result/planar_sum.h"

namespace dymsum::planar {

/// Why P cannot be eroded by Q, or by Q turned.
std::optional<Error> not_erodible(const Region& p, const Region& q);

/// The largest coordinate of an operand around which a frame is laid: widths are at most twice as large, and the
/// frame's coordinates eight times that.
inline constexpr double kLargestFramed = 0x1p996;

/// How the sum of complement_of(P, Q) and -Q is to be computed for an erosion with `options`.
SumOptions options_inside(const SumOptions& options);

/// The erosion, of that sum.
PlanarSum inside_of_frame(SumState&& state, const SumOptions& options);

}  // namespace dymsum::planar
