// Tables of frames that scale, one by one, and of many copies.
#pragma once

#include <string>
#include <vector>

#include "page.h"
#include "scaling/pairs.h"

namespace dymsum::bench {

/// Steps of 0.1, 1 and 10 %, every frame compared; `rivals`: beside all pairs and CGAL.
void steady_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, bool rivals);
/// Windows only, from scratch only, and the controller.
void modes_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted);
/// Random scales.
void table_6_1(Report& report, const Wanted& wanted);
/// Figure 6.11: an environment of twelve copies of one obstacle, with a robot.
void copies_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, bool baseline);
/// The thesis's counts.
void pair_events_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted);
/// Figures 6.6 and 6.7, into a folder.
void figures(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, const std::string& folder);

}  // namespace dymsum::bench
