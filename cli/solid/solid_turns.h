// rotate --events with solid operands: the exact angles at which their sum changes.
#pragma once

#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "exit_code.h"
#include "options.h"
#include "report.h"
#include "solid/solid_motion.h"

namespace dymsum::cli {

struct SolidTurns {
  std::vector<SolidInput> inputs;
  std::string axis, range;     ///< as they were written; an empty range is a whole turn
  bool next = false;           ///< the first visible event after the range's beginning alone
  bool next_topology = false;  ///< the first one that changes shells, tunnels or tight features
};

/// Those of a turn that begins at zero and is at most a whole one, clockwise where it is negative.
std::vector<MotionEvent> rotation_events(const std::vector<SolidInput>& inputs, const std::string& axis,
                                         const Angle& turn);

/// Ends with 4 where there is no next event.
ExitCode run_solid_turns(const SolidTurns& turns, const ReportOptions& report);

}  // namespace dymsum::cli
