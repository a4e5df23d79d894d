// Drawings whose lines nearly meet.
#pragma once

#include <string>

#include "dymsum/region.h"

namespace dymsum::cli {

/// Says on standard error where the open lines of a region without parts end so near each other that they were meant to
/// meet, which makes rings of a drawing: how many, and how far apart they are.
void report_open_ends(const RegionData& data, const std::string& file);

}  // namespace dymsum::cli
