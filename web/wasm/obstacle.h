// Configurations of a robot.
#pragma once

#include "bind.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/motion.h"

namespace dymsum::web {

Configuration configuration_in(const val& v);
Touching touching_in(const val& v);

}  // namespace dymsum::web
