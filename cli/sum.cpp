// dymsum sum P Q
#include <memory>

#include "commands.h"

namespace dymsum::cli {

void add_sum(CLI::App& app, Action& action) {
  auto command = std::make_shared<SumCommand>();
  command->verb = "sum";
  command->compute = minkowski_sum;
  CLI::App* verb = app.add_subcommand("sum", "The Minkowski sum P + Q = { p + q : p in P, q in Q }");
  add_sum_options(*verb, *command, "P", "Q");
  verb->footer("Example: dymsum sum gear.poly disc.wkt -o sum.svg -o sum.json");
  verb->callback([command, &action] { action = [command] { return run_sum(*command); }; });
}

}  // namespace dymsum::cli
