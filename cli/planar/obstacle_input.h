// The obstacle (x, y, theta) that verbs ask: of two operands, or read from a file.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "inputs.h"
#include "report.h"
#include "timing.h"

namespace dymsum::cli {

struct ObstacleInput {
  std::vector<std::string> operands{"", ""};
  std::string file;
  InputOptions input;
};

struct ObstacleSource {
  std::vector<Input> inputs;           ///< robot and obstacle
  std::optional<CspaceObstacle> read;  ///< from a file
};

/// ROBOT and OBSTACLE, or --obstacle FILE.
void add_obstacle_input(CLI::App& verb, ObstacleInput& input);
/// A Stop with kUsage unless one of the two is given.
void check_obstacle_input(const std::string& verb, const ObstacleInput& input);
ObstacleSource read_source(const ObstacleInput& input);
/// The one that was read, which leaves the source, or that of a robot.
CspaceObstacle obstacle_of(ObstacleSource& source, const Region& robot, const ObstacleOptions& options);
/// That of the source's robot, behind a progress bar.
CspaceObstacle obstacle_of(ObstacleSource& source);
/// The head of a report of answers from an obstacle.
Json report_of_answers(const std::string& verb, const ObstacleSource& source, const CspaceObstacle& obstacle,
                       const Timing& timing);

}  // namespace dymsum::cli
