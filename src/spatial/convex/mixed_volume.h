// The volume of a sum of convex solids from the extreme vertices alone:
// V(P + Q) = V(P) + sum over faces f of P of |f| h_Q(n_f) + sum over faces g of Q of |g| h_P(n_g) + V(Q), with support
// functions h (Minkowski).
#pragma once

#include <optional>

#include "dymsum/rotation.h"
#include "exact/big.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

exact::BigRational exact_mixed_volume(const Overlay& overlay, const SolidPose& p, const SolidPose& q);
/// The same in doubles, with a relative error of at most kMixedVolumeError; nothing where that cannot be determined, as
/// of solids much thinner than long.
std::optional<double> mixed_volume(const Overlay& overlay, const PoseFactors& p, const PoseFactors& q);
constexpr double kMixedVolumeError = 0x1p-41;

}  // namespace dymsum::spatial
