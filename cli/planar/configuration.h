// Configurations on the command line.
#pragma once

#include <string>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/rational.h"

namespace dymsum::cli {

/// "x,y,theta", theta in radians or as 90deg, all finite and positions at most 2^400. Stops with wrong usage otherwise;
/// `option` names it in the message.
Configuration read_configuration(const std::string& text, const char* option);

/// The same where x and y may be fractions.
struct PlacedRobot {
  RationalPoint at;
  double theta = 0;
};
PlacedRobot read_placed_robot(const std::string& text, const char* option);

/// One on every line of FILE, or "-", as for_each_query reads them. Stops with bad input that names file and line.
std::vector<PlacedRobot> read_placed_robots(const std::string& file);

}  // namespace dymsum::cli
