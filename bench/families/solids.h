// Families of sums of solids against sums from scratch at the same scales and angles.
#pragma once

#include <string>

#include "page.h"
#include "solid/inputs.h"

namespace dymsum::bench {

/// A row for every pair whose name contains `only`: making, queries in cells that were asked before and in others.
void measure_solid_scalings(Report& report, const std::string& only, const std::string& data);
void measure_solid_turns(Report& report, const std::string& only, const std::string& data);

}  // namespace dymsum::bench
