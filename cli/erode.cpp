// dymsum erode P Q
#include <memory>

#include "commands.h"

namespace dymsum::cli {

void add_erode(CLI::App& app, Action& action) {
  auto command = std::make_shared<SumCommand>();
  command->verb = "erode";
  command->compute = erode;
  command->reflects_second = true;
  CLI::App* verb = app.add_subcommand(
      "erode", "The inner fit { x : x + Q inside P }; ends with 4 when Q fits nowhere, also not exactly");
  add_sum_options(*verb, *command, "P", "Q");
  verb->footer("Example: dymsum erode sheet.wkt part.wkt --json");
  verb->callback([command, &action] { action = [command] { return run_sum(*command, true); }; });
}

}  // namespace dymsum::cli
