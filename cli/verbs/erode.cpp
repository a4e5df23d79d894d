// dymsum erode CONTAINER PART
#include "dymsum/solid_erosion.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

void add_erode(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "erode";
  verb.first = {"CONTAINER", "The region or solid P to stay inside of"};
  verb.second = {"PART", "The one Q that is to fit"};
  verb.description =
      "The inner fit { x : x + PART inside CONTAINER }; ends with 4 when the part fits nowhere, also not exactly "
      "(with --semantics regular: nowhere with room to move both ways)";
  verb.footer =
      "Positions are those of PART's reference point, the origin of its coordinates. Those without room to move are "
      "the\n"
      "tight features: of solids faces, segments and points.\n"
      "Example: dymsum erode sheet.wkt part.wkt --json\n"
      "Example: dymsum erode slot.wkt peg.wkt --tolerance +0.0105/0,-0.0035/-0.01";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) {
    return erode(sets[0], sets[1], options);
  };
  verb.solid = [](const Mesh& a, const Mesh& b, const SpatialOptions& options) { return erode(a, b, options); };
  verb.result = [](const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
    return erode(a, b, options);
  };
  verb.reflects_second = true;
  verb.empty_is_no = true;
  verb.names.sum = "P ⊖ Q";
  verb.uncertain = [](const Uncertain& p, const Uncertain& q, const SumOptions& options) {
    return erode(p, q, options);
  };
  verb.page = "sum";
  verb.solid_page = "solids";
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
