// dymsum sum P Q...
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

void add_sum(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "sum";
  verb.first = {"P", "A region or solid"};
  verb.second = {"Q", "Another one of the same kind"};
  verb.description = "The Minkowski sum P + Q = { p + q : p in P, q in Q }, of any number of operands";
  verb.footer =
      "A result in .json is an operand: it is read back exactly.\n"
      "Example: dymsum sum gear.poly disc.wkt -o sum.svg -o sum.json\n"
      "Example: dymsum sum gear.poly disc.wkt -o - --to json | dymsum erode - disc.wkt";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) {
    return minkowski_sum(sets, options);
  };
  verb.solid = [](const Mesh& p, const Mesh& q, const SpatialOptions& options) { return minkowski_sum(p, q, options); };
  verb.several = true;
  verb.is_sum = true;
  verb.uncertain = [](const Uncertain& p, const Uncertain& q, const SumOptions& options) {
    return minkowski_sum(p, q, options);
  };
  verb.page = "sum";
  verb.solid_page = "solids";
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
