// What writers and readers of obstacles agree on.
#pragma once

#include "io/checked_json.h"

namespace dymsum::io {

inline constexpr CheckedFormat kObstacleFormat{"dymsum obstacle", 1, "an obstacle"};

}  // namespace dymsum::io
