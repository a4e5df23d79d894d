// dymsum nfp A B
#include <memory>

#include "commands.h"

namespace dymsum::cli {

void add_nfp(CLI::App& app, Action& action) {
  auto command = std::make_shared<SumCommand>();
  command->verb = "nfp";
  command->compute = nfp;
  command->reflects_second = true;
  CLI::App* verb = app.add_subcommand("nfp", "The no-fit polygon A + (-B): where B's reference point makes B meet A");
  add_sum_options(*verb, *command, "A", "B");
  verb->footer("Example: dymsum nfp \"swim.json#0\" \"swim.json#3\" --repair -o nfp.svg");
  verb->callback([command, &action] { action = [command] { return run_sum(*command); }; });
}

}  // namespace dymsum::cli
