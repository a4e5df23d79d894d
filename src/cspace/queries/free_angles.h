// The angles at which a position is free: between those at which patches pass through it.
#pragma once

#include <functional>
#include <vector>

#include "cspace/queries/patch_forms.h"
#include "dymsum/obstacle_queries.h"

namespace dymsum::cspace {

/// `is_free` answers exactly at an angle in [-pi, pi].
std::vector<FreeAngles> free_angles(const CspaceObstacle& obstacle, const PatchForms& forms, Point at,
                                    const std::function<bool(double)>& is_free);

}  // namespace dymsum::cspace
