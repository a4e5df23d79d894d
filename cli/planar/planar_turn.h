// Planar regions that turn, frame by frame: what rotate does with planar operands.
#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "options.h"

namespace dymsum::cli {

struct PlanarRotation {
  std::vector<std::string> operands{"", ""}, files;
  std::vector<Angle> angles;  ///< of the frames
  double error = 1e-6;        ///< in radians: the simplest exact orientation within it is taken
  std::string semantics = "closed";
  std::size_t threads = 1;
  double memory_mb = 0;  ///< 0: no limit
  ReportOptions report;
  InputOptions input;
};

/// Computes the frames, writes pictures and reports.
ExitCode run_planar_rotation(const PlanarRotation& turn);

}  // namespace dymsum::cli
