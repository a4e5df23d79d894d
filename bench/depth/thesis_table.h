// Table 7.1 of the thesis: local sums of four pairs while one of them turns, and the planar ones.
#pragma once

#include "coordinate_kinds.h"
#include "page.h"

namespace dymsum::bench {

/// Whole, brute, by hierarchy, updated; medians over so many frames, and the thesis's figures beside them.
void thesis_table(int frames, Kind kind, Report& report);

/// Sums of regions near a position, against the whole sum at the same poses.
void planar_local_sums(int frames, Kind kind, Report& report);

}  // namespace dymsum::bench
