// Solids that are convex but for rounding.
#pragma once

#include "solid/solid_inputs.h"

namespace dymsum::cli {

/// Says on standard error of a solid that only edges keep from being convex which are reflex by no more than rounding
/// that --hull takes its convex hull.
void report_nearly_convex(const SolidInput& input);

}  // namespace dymsum::cli
