// scale-range with solid operands.
#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "inputs.h"
#include "options.h"

namespace dymsum::cli {

/// What the command line requests of the verb scale-range.
struct RangeCommand {
  std::vector<std::string> operands{"", ""};
  std::string path, position;
  bool inside = false;
  ReportOptions report;
  InputOptions input;
};

ExitCode run_solid_scale_range(const RangeCommand& command);

}  // namespace dymsum::cli
