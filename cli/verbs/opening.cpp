// dymsum opening A B, dymsum closing A B
#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <utility>

#include "dymsum/solid_erosion.h"
#include "solid/solid_command.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {
namespace {

struct OpeningCommand {
  SolidCommand solid;
  bool round_between = false;
};

using Operation = Result<SolidOpening> (*)(const SpatialOperand&, const SpatialOperand&, const SpatialOptions&,
                                           BetweenSteps);
using PlanarOperation = Result<PlanarSum> (*)(const PlanarOperand&, const PlanarOperand&, const SumOptions&);

/// What the verb is in the plane, and of solids.
struct TwoSteps {
  std::string name, set;
  PlanarOperation planar;
  Operation solid;
};

ExitCode run_planar(const TwoSteps& steps, const OpeningCommand& command) {
  const SolidCommand& requested = command.solid;
  refuse_options(*requested.parser, {"--round-between"},
                 "is for solids: in the plane nothing is rounded between the steps");
  refuse_options(*requested.parser, {"--hull"}, "is for solids");
  SumVerb verb;
  verb.name = steps.name;
  verb.planar = [planar = steps.planar](std::span<const PlanarOperand> sets, const SumOptions& options) {
    return planar(sets[0], sets[1], options);
  };
  verb.empty_is_no = verb.two_steps = true;
  verb.names.sum = steps.set;
  SumCommand sum;
  sum.parser = requested.parser;
  sum.operands = requested.operands;
  sum.memory_mb = requested.memory_mb;
  sum.engine = requested.engine;
  sum.semantics = requested.semantics;
  sum.report = requested.report;
  sum.input = requested.input;
  sum.output.files = requested.files;
  sum.output.to = requested.parser->count("--to") > 0 ? requested.to : "wkt";
  return run_sum(verb, sum);
}

ExitCode run(const TwoSteps& steps, const OpeningCommand& command) {
  const std::string& verb = steps.name;
  if (!are_solid(command.solid.operands, command.solid.input)) return run_planar(steps, command);
  const SolidRun run = read_solid_run(verb, command.solid);
  const BetweenSteps between = command.round_between ? BetweenSteps::rounded : BetweenSteps::exact;
  return run_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    Result<SolidOpening> made = steps.solid(run.inputs[0].operand(), run.inputs[1].operand(), options, between);
    if (!made) {
      Error error = made.error();
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

void add(CLI::App& app, Action& action, const TwoSteps& steps, const std::string& description) {
  const std::string& name = steps.name;
  auto command = std::make_shared<OpeningCommand>();
  CLI::App& verb = *app.add_subcommand(name, description);
  command->solid.operands = {"", ""};
  add_operands(verb, {"A", "A region or solid"}, {"B", "The one of the same kind that it is worked with"},
               command->solid.operands);
  add_solid_options(verb, command->solid, OperandKind::either);
  add_lines_option(verb, command->solid.input);
  verb.add_flag(
      "--round-between", command->round_between,
      "Solids: round vertices between the two operations that have no doubles for coordinates, and report how far "
      "that moved them; without it they are fractions, and the result is exact");
  verb.footer("Both steps are exact. A result in .json is an operand.\nExample: dymsum " + name +
              " plate.wkt tool.wkt -o " + name + ".json\nExample: dymsum " + name + " part.off tool.off -o " + name +
              ".off --json");
  verb.callback([=, &action] { action = [=] { return run(steps, *command); }; });
}

}  // namespace

void add_opening(CLI::App& app, Action& action) {
  add(app, action, {"opening", "(P ⊖ Q) ⊕ Q", opening, opening},
      "All of A that translates of B inside A cover: erosion, then sum; ends with 4 where B does not fit");
}

void add_closing(CLI::App& app, Action& action) {
  add(app, action, {"closing", "(P ⊕ Q) ⊖ Q", closing, closing},
      "A with all that translates of -B outside of A do not reach: sum, then erosion");
}

}  // namespace dymsum::cli
