// A picture of a planned path: the obstacle, and the robot along the way.
#pragma once

#include <string>

#include "dymsum/planner.h"

namespace dymsum::cli {

/// SVG text. The robot at the waypoints, paler ones between them, the way of its reference point.
std::string path_picture(const Region& robot, const Region& obstacle, const std::vector<Waypoint>& path);

}  // namespace dymsum::cli
