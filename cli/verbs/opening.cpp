// dymsum opening A B, dymsum closing A B
#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <utility>

#include "dymsum/solid_erosion.h"
#include "solid/solid_command.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct OpeningCommand {
  SolidCommand solid;
  bool round_between = false;
};

using Operation = Result<SolidOpening> (*)(const Mesh&, const Mesh&, const SpatialOptions&, BetweenSteps);

ExitCode run(const std::string& verb, Operation operation, const OpeningCommand& command) {
  if (!are_solid(command.solid.operands, command.solid.input))
    throw Stop(kUsage, verb + " is for solids: .off .obj .stl .ply .glb .3mf, not " +
                           shown_file(command.solid.operands[0]) + "; regions and polylines have the " + verb +
                           " by a disc: dymsum disc " + shown_file(command.solid.operands[0]) + " --radius R --set " +
                           verb);
  const SolidRun run = read_solid_run(verb, command.solid);
  const BetweenSteps between = command.round_between ? BetweenSteps::rounded : BetweenSteps::exact;
  return run_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    Result<SolidOpening> made = operation(run.inputs[0].mesh, run.inputs[1].mesh, options, between);
    if (!made) {
      Error error = made.error();
      if (error.code == ErrorCode::out_of_range && !command.round_between)
        error.message += " (--round-between rounds what is between the two operations)";
      if (error.code == ErrorCode::rounding_changed_topology && command.round_between)
        error.message += " (of what is between the two operations)";
      return error;
    }
    const double moved = made->moved;
    SolidOutcome outcome{std::move(*std::move(made)).solid, {{"moved", moved}}, ""};
    if (moved > 0) {
      std::ostringstream text;
      text << "vertices between the two operations were rounded, and moved by at most " << moved;
      outcome.text = text.str();
    }
    return outcome;
  });
}

void add(CLI::App& app, Action& action, const std::string& name, Operation operation, const std::string& description) {
  auto command = std::make_shared<OpeningCommand>();
  CLI::App& verb = *app.add_subcommand(name, description);
  command->solid.operands = {"", ""};
  add_operands(verb, {"A", "The solid"}, {"B", "The solid it is worked with"}, command->solid.operands,
               OperandKind::solid);
  add_solid_options(verb, command->solid);
  verb.add_flag("--round-between", command->round_between,
                "Round vertices between the two operations that have no doubles for coordinates, and report how far "
                "that moved them; without it they are fractions, and the result is exact");
  verb.footer("Example: dymsum " + name + " part.off tool.off -o " + name + ".off --json");
  verb.callback([=, &action] { action = [=] { return run(name, operation, *command); }; });
}

}  // namespace

void add_opening(CLI::App& app, Action& action) {
  add(app, action, "opening", opening,
      "All of the solid A that translates of B inside A cover: erosion, then sum; ends with 4 where B does not fit");
}

void add_closing(CLI::App& app, Action& action) {
  add(app, action, "closing", closing,
      "The solid A with all that translates of -B outside of A do not reach: sum, then erosion");
}

}  // namespace dymsum::cli
