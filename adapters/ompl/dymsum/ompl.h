/// \file
/// dymsum for OMPL: exact state validity with clearance, certified motions, and a planner that finds a path or proves
/// that there is none, for a polygonal robot in SE(2). Header-only; a program that includes it links OMPL itself.
#pragma once

#include "dymsum/ompl/certified_motion_validator.h"
#include "dymsum/ompl/exact_planner.h"
#include "dymsum/ompl/exact_validity_checker.h"
#include "dymsum/ompl/scene.h"
