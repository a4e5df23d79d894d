// dymsum sum P Q
#include "commands.h"
#include "sum_command.h"

namespace dymsum::cli {

void add_sum(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "sum";
  verb.first = "P";
  verb.second = "Q";
  verb.description = "The Minkowski sum P + Q = { p + q : p in P, q in Q }";
  verb.example = "dymsum sum gear.poly disc.wkt -o sum.svg -o sum.json";
  verb.compute = minkowski_sum;
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
