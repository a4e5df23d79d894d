// Tables of whole sweeps, and what the project promises of them.
#pragma once

#include <string>
#include <vector>

#include "page.h"
#include "scaling/sweep.h"

namespace dymsum::bench {

/// Scales in the steps that users type, on raw and snapped coordinates, or on those of a kind: there, back and
/// scattered.
std::vector<SweepRow> scaling_sweeps(Report& report, const std::string& data, Kind kind, const Wanted& wanted);
/// Whole turns of 60 and 500 steps.
std::vector<SweepRow> turning_sweeps(Report& report, const std::string& data, Kind kind, const Wanted& wanted);

void sweep_promises(Report& report, const std::vector<SweepRow>& scaling, const std::vector<SweepRow>& turning);

/// One line a row and pass: the time of every frame, and of the static sum at every position, in milliseconds.
std::string sweep_csv(const std::vector<SweepRow>& rows);

}  // namespace dymsum::bench
