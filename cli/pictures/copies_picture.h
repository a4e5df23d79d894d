// A picture of an environment of scaled copies: figure 6.11 of the thesis.
#pragma once

#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"

namespace dymsum::cli {

/// The obstacles, what they grow to in the configuration space of the robot, and the robot where it touches one of
/// them; SVG text. Requires: sums are those of the copies with the reflected robot.
std::string copies_picture(const Region& master, const Region& robot, const std::vector<ScaledCopy>& copies,
                           const std::vector<CopySum>& sums);

}  // namespace dymsum::cli
