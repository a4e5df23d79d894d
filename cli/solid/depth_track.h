// `dymsum depth --track`: exact and continuous depth along a motion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exit_code.h"
#include "options.h"

namespace dymsum::cli {

struct TrackOptions {
  std::string motion;               ///< the file of poses
  std::vector<std::string> files;   ///< -o
  std::optional<double> smoothing;  ///< the library's default, if not given
  double inflation = 2;
};

/// Poses x,y,z or x,y,z,w,x,y,z (a position and a quaternion) of Q, one a line; a row for each.
ExitCode run_track(const std::vector<std::string>& operands, const TrackOptions& track, const ReportOptions& report,
                   const InputOptions& input);

}  // namespace dymsum::cli
