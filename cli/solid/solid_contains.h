// Whether positions lie in the sum of two solids: what contains does with solid operands.
#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "options.h"
#include "solid/solid_operands.h"

namespace dymsum::cli {

struct SolidContains {
  std::vector<std::string> operands, at;  ///< files; "x,y,z" each
  std::string at_file, semantics;         ///< empty: closed
  ReportOptions report;
  InputOptions input;
};

ExitCode run_solid_contains(const SolidContains& command);

}  // namespace dymsum::cli
