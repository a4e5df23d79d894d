// dymsum offset SOLID --by D
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "dymsum/solid_offset.h"
#include "options.h"
#include "solid/solid_command.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct OffsetCommand {
  SolidCommand solid;
  double by = 0;
  std::optional<double> tolerance;
  std::string bound = "inside";
};

ExitCode run(const OffsetCommand& command) {
  const double tolerance = command.tolerance.value_or(std::abs(command.by) / 50);
  const OffsetBound bound = named<OffsetBound>(command.bound);
  // What is no distance is wrong usage, told before anything is read.
  if (command.by == 0) throw Stop(kUsage, "--by wants a distance, not 0");
  if (const auto ball = tessellated_ball(std::abs(command.by), tolerance, bound); !ball) {
    // A distance that no tolerance goes with, or a tolerance that does not go with it.
    const bool any = command.tolerance && tessellated_ball(std::abs(command.by), std::abs(command.by) / 50, bound);
    throw Stop(kUsage, (any ? "--tolerance: " : "--by: ") + ball.error().to_string(), ball.error());
  }
  const SolidRun run = read_solid_run("offset", command.solid);
  return run_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    const SolidInput& input = run.inputs[0];
    Result<SolidOffset> made = offset(input.operand(), command.by, tolerance, bound, options);
    if (!made) return made.error();
    const Json more{{"by", command.by},
                    {"low", made->low},
                    {"high", made->high},
                    {"bound", command.bound},
                    {"ball_facets", made->ball_facets}};
    std::ostringstream text;
    text.precision(17);
    text << "contains the offset by " << made->low << " and lies in that by " << made->high << "; a ball of "
         << made->ball_facets << " facets";
    return SolidOutcome{std::move(*std::move(made)).solid, more, text.str()};
  });
}

}  // namespace

void add_offset(CLI::App& app, Action& action) {
  auto command = std::make_shared<OffsetCommand>();
  CLI::App& verb = *app.add_subcommand(
      "offset", "A solid grown, or for a negative distance shrunk, by a ball of plane facets with a stated error");
  command->solid.operands = {""};
  verb.add_option("SOLID", command->solid.operands[0], "The solid: a file, or - for standard input")
      ->required()
      ->type_name("");
  within(verb.add_option("--by", command->by, "The distance; negative ones go inward"), -1e90, 1e90)
      ->required()
      ->type_name("D");
  within(verb.add_option("--tolerance", command->tolerance,
                         "Largest difference to the exact offset; a 50th of the distance if not given"),
         0)
      ->type_name("T");
  one_of<OffsetBound>(
      verb.add_option("--bound", command->bound, "inside: contained in the exact offset; outside: containing it"))
      ->capture_default_str();
  add_solid_options(verb, command->solid);
  verb.footer(
      "The sum with the ball, or the inner fit of it, is exact: what differs from the offset is the ball alone.\n"
      "Exit code 4 where nothing is left.\n"
      "Example: dymsum offset part.off --by 0.5 --tolerance 0.01 -o grown.off");
  verb.callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
