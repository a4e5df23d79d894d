// Solids of any shape that turn or scale, frame by frame: what rotate and scale do where an operand is not convex.
#pragma once

#include "solid/solid_motion.h"

namespace dymsum::cli {

/// Makes the frames, writes the one that is shown and reports.
ExitCode run_moving_solids(const SolidMotion& motion, const ReportOptions& report);

}  // namespace dymsum::cli
