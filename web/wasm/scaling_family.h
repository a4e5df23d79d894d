// The class of ScalingFamily, to which further/ adds members that no page calls.
#pragma once

#include "bind.h"
#include "dymsum/scaling_family.h"

namespace dymsum::web {

emscripten::class_<ScalingFamily>& scaling_family_handle();

}  // namespace dymsum::web
