// dymsum nfp A B
#include "commands.h"
#include "sum_command.h"

namespace dymsum::cli {

void add_nfp(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "nfp";
  verb.first = "A";
  verb.second = "B";
  verb.description = "The no-fit polygon A + (-B): where B's reference point makes B meet A";
  verb.example = "dymsum nfp 'swim.json#0' 'swim.json#3' --repair -o nfp.svg";
  verb.compute = nfp;
  verb.reflects_second = true;
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
