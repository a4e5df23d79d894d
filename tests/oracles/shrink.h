// Makes a failing pair of operands smaller while it keeps failing.
#pragma once

#include <functional>

#include "tiny_regions.h"

namespace dymsum::oracles {

/// `fails(p, q)` holds for the given pair and for the returned one; in the latter no single piece, hole or vertex can
/// be left out and no coordinate moved towards zero by a half or by one with the failure kept. `fails` must refuse
/// invalid regions itself. At most `budget` calls.
Pair shrink(Pair pair, const std::function<bool(const RegionData&, const RegionData&)>& fails, int budget = 3000);

}  // namespace dymsum::oracles
