// dymsum slice ROBOT OBSTACLE --tan-half N/D | --angle RAD
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "commands.h"
#include "dymsum/cspace_obstacle.h"
#include "sum_command.h"
#include "turned_region.h"

namespace dymsum::cli {
namespace {

struct SliceCommand {
  SumCommand sum;
  std::string tan_half;
  std::optional<double> radians, error;
};

Orientation asked_orientation(const SliceCommand& command) {
  if (command.tan_half.empty() == !command.radians) throw Stop(kUsage, "give one of --tan-half and --angle");
  if (command.error && !command.radians) throw Stop(kUsage, "--error belongs to --angle");
  const auto made = !command.radians ? Orientation::parse(command.tan_half)
                    : command.error  ? Orientation::nearest(*command.radians, *command.error)
                                     : Orientation::nearest(*command.radians);
  if (!made) throw Stop(kUsage, (command.radians ? "--angle: " : "--tan-half: ") + made.error().to_string());
  return *made;
}

SumVerb slice_verb() {
  SumVerb verb;
  verb.name = "slice";
  verb.first = "ROBOT";
  verb.second = "OBSTACLE";
  verb.description = "One orientation of a configuration-space obstacle: OBSTACLE (+) -ROBOT, the robot turned exactly";
  verb.example = "dymsum slice peg.wkt slot.wkt --tan-half 1/3 -o slice.svg";
  verb.planar_only = true;
  verb.reflects_second = true;
  return verb;
}

ExitCode run_slice(const SliceCommand& command) {
  SumVerb verb = slice_verb();
  const Orientation theta = asked_orientation(command);
  verb.orientation = theta;
  verb.compute = [theta](const Region& robot, const Region& obstacle, const SumOptions& options) {
    return cspace_slice(robot, obstacle, theta, options);
  };
  verb.shown = [theta](const Region& robot, const Region& obstacle) {
    return std::array{obstacle, turned(robot, theta).value_or(robot)};
  };
  return run_sum(verb, command.sum);
}

}  // namespace

void add_slice(CLI::App& app, Action& action) {
  auto command = std::make_shared<SliceCommand>();
  CLI::App& verb = declare_sum_verb(app, slice_verb(), command->sum);
  verb.add_option("--tan-half", command->tan_half, "Tangent of half the angle, exact: 3/7, 0.25; inf is half a turn")
      ->type_name("N/D");
  verb.add_option("--angle", command->radians, "The angle; met within 2^-50, or within --error by a simpler tangent")
      ->type_name("RAD");
  verb.add_option("--error", command->error, "Largest error of --angle")->type_name("E");
  verb.callback([command, &action] { action = [command] { return run_slice(*command); }; });
}

}  // namespace dymsum::cli
