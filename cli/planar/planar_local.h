// Sums of regions near a position: what local-sum does with planar operands.
#pragma once

#include <string>
#include <vector>

#include "dymsum/planar_local_sum.h"
#include "exit_code.h"
#include "options.h"

namespace dymsum::cli {

struct PlanarLocal {
  std::vector<std::string> operands{"", ""}, files;
  std::string box, disc;  ///< "x,y,x,y" or "x,y,r": one of them
  std::string to = "json";
  LocalEngine engine = LocalEngine::updated;
  std::string engine_name;
  AngleOptions angle;    ///< that P turns by
  double memory_mb = 0;  ///< 0: no limit
  ReportOptions report;
  InputOptions input;
};

/// Computes the part, writes the outputs and reports.
ExitCode run_planar_local(const PlanarLocal& local);

}  // namespace dymsum::cli
