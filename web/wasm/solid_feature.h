// Features of solids as numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::web {

/// Three numbers: kind, a, b.
void add(std::vector<std::uint32_t>& numbers, const SolidFeature& feature);

}  // namespace dymsum::web
