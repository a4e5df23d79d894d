// Making up for a single rounding.
#pragma once

#include "exact/rounding_bound.h"

namespace dymsum::exact {

/// Factors of a positive number x = fl(y): fl(x kUp) >= y and fl(x kDown) <= y, as either moves x by a unit in its last
/// place at least.
inline constexpr double kUp = 1 + 2 * kRoundoff, kDown = 1 - 2 * kRoundoff;

}  // namespace dymsum::exact
