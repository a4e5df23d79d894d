// What the sums of all variants have in common, without computing all of these sums.
#pragma once

#include <functional>

#include "dymsum/planar_operand.h"
#include "dymsum/result.h"
#include "dymsum/uncertain.h"

namespace dymsum::uncertain {

/// The intersection of sum(V) over the variants V of `list`, exactly, for a `sum` that is monotone and distributes over
/// unions. With C what all variants have in common and D the closure of the rest of each one,
///   V = C + D (their union), so that the intersection is that of all sum(D), together with sum(C).
/// Requires: variants without polylines and points. Cost: one sum of C, sums of the D, whose sizes are those of what
/// differs, and an intersection of these.
Result<PlanarSum> common_sum(const Uncertain& list, const std::function<Result<PlanarSum>(const PlanarOperand&)>& sum,
                             const SumOptions& options);

}  // namespace dymsum::uncertain
