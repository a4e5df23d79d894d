// A picture of what lives how long in a family of sums.
#pragma once

#include <string>
#include <vector>

#include "dymsum/scaling_family.h"

namespace dymsum::cli {

/// Scales to the right, by their logarithms; below one another: the visible events as ticks, those that change the
/// topology longer and red; how many vertices the sum has in every cell; a bar for every lifetime of a hole, each hole
/// in a row of its own. SVG text.
std::string lifetimes_picture(const ScalingFamily& family, const std::vector<Lifetime>& lifetimes,
                              const std::string& title);

}  // namespace dymsum::cli
