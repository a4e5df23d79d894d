// Configurations on the command line.
#pragma once

#include <string>
#include <vector>

#include "dymsum/rational.h"

namespace dymsum::cli {

/// "x,y,theta": numbers or fractions, theta in radians or as 90deg, positions at most 2^400.
struct PlacedRobot {
  RationalPoint at;
  double theta = 0;
};
/// Stops with wrong usage for other text; `option` names it in the message.
PlacedRobot read_placed_robot(const std::string& text, const char* option);

/// One on every line of FILE, or "-", as for_each_query reads them. Stops with bad input that names file and line.
std::vector<PlacedRobot> read_placed_robots(const std::string& file);

}  // namespace dymsum::cli
