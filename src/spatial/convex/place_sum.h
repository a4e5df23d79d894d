// Rounded positions of an assembled sum.
#pragma once

#include "dymsum/convex_sum.h"

namespace dymsum::spatial {

/// Fills sum.at: every coordinate the double nearest to the exact value.
void place_sum(SolidSum& sum);

}  // namespace dymsum::spatial
