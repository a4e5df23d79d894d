// Convex solids that turn or scale, frame by frame: what rotate and scale do with solid operands.
#pragma once

#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "exit_code.h"
#include "solid/solid_operands.h"
#include "verbs/scale_command.h"

namespace dymsum::cli {

struct SolidFramePose {
  SolidPose p, q;
  std::string label;  ///< "s = 3/2", "90 degrees"
};

/// Visits the poses, writes pictures and reports. `verb` names it; `files` may end in .html (a page that plays), or be
/// a mesh of the last frame.
ExitCode run_solid_motion(const std::string& verb, const std::vector<SolidInput>& inputs,
                          const std::vector<SolidFramePose>& poses, const std::vector<std::string>& files,
                          const ReportOptions& report);

/// scale with solid operands: `sweep` as parsed, or --at with one scale or three a frame.
ExitCode run_solid_scale(const ScaleCommand& command, const std::vector<Scale>& sweep);

}  // namespace dymsum::cli
