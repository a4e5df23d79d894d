// dymsum nfp FIXED MOVING
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

void add_nfp(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "nfp";
  verb.first = {"FIXED", "The shape A that stays"};
  verb.second = {
      "MOVING",
      "The shape B that moves; the result holds places of its reference point, the origin of its coordinates"};
  verb.description =
      "The no-fit polygon FIXED + (-MOVING): where the moving shape's reference point makes it meet the fixed one";
  verb.footer =
      "The shape that stays comes first. slice, cspace, clearance and path take the ROBOT first: nfp OBSTACLE ROBOT "
      "is\n"
      "slice ROBOT OBSTACLE at angle 0.\nExample: dymsum nfp 'swim.json#0' 'swim.json#3' --repair -o nfp.svg";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) {
    return nfp(sets[0], sets[1], options);
  };
  verb.solid = [](const Mesh& fixed, const Mesh& moving, const SpatialOptions& options) {
    return minkowski_sum(fixed, negated(moving), options);
  };
  verb.reflects_second = true;
  verb.is_sum = true;
  verb.names = {"A", "B", "A ⊕ −B"};
  verb.uncertain = [](const Uncertain& p, const Uncertain& q, const SumOptions& options) { return nfp(p, q, options); };
  verb.page = "nesting";
  verb.solid_page = "solids";
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
