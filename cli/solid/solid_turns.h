// rotate --events with solid operands: the exact angles at which their sum changes.
#pragma once

#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "exit_code.h"
#include "report.h"
#include "solid/solid_inputs.h"

namespace dymsum::cli {

struct SolidTurns {
  std::vector<SolidInput> inputs;
  std::string axis, range;     ///< as they were written; an empty range is a whole turn
  bool next = false;           ///< the first visible event behind the range's beginning alone
  bool next_topology = false;  ///< the first one that changes shells, tunnels or tight features
};

/// Ends with 4 where there is no next event.
ExitCode run_solid_turns(const SolidTurns& turns, const ReportOptions& report);

}  // namespace dymsum::cli
