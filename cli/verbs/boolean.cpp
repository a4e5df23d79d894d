// dymsum union A B..., dymsum intersect A B..., dymsum subtract A B...
#include <memory>

#include "dymsum/planar_boolean.h"
#include "dymsum/solid_union.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {
namespace {

SumVerb boolean_verb(const std::string& name, const std::string& sign) {
  SumVerb verb;
  verb.name = name;
  verb.first = {"A", "A region or solid"};
  verb.second = {"B", "Another one of the same kind"};
  verb.several = verb.boolean = true;
  verb.semantics = "regular";
  verb.page = "sum";
  verb.solid_page = "solids";
  verb.names = {"A", "B", "A " + sign + " B"};
  return verb;
}

}  // namespace

void add_union(CLI::App& app, Action& action) {
  SumVerb verb = boolean_verb("union", "∪");
  verb.description = "What lies in one of the operands, exactly";
  verb.footer =
      "With --semantics open operands are open: where they only touch, that is tight.\n"
      "Example: dymsum union plate.wkt rib.wkt boss.wkt -o part.json -o part.svg";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) { return united(sets, options); };
  verb.solids = [](std::span<const SpatialOperand> solids, const SpatialOptions& options) {
    return united(solids, options);
  };
  add_sum_verb(app, verb, action);
}

void add_intersect(CLI::App& app, Action& action) {
  SumVerb verb = boolean_verb("intersect", "∩");
  verb.description = "What lies in all of the operands, exactly; ends with 4 where that is nothing";
  verb.footer =
      "With --semantics closed what only touches counts: segments and points, of solids faces, too.\n"
      "Example: dymsum intersect sheet.wkt part.wkt --json";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) {
    return intersection(sets, options);
  };
  verb.solids = [](std::span<const SpatialOperand> solids, const SpatialOptions& options) {
    return intersection(solids, options);
  };
  verb.empty_is_no = true;
  add_sum_verb(app, verb, action);
}

void add_subtract(CLI::App& app, Action& action) {
  SumVerb verb = boolean_verb("subtract", "∖");
  verb.description =
      "What lies in the first operand and in none of the others, exactly; ends with 4 where that is nothing";
  verb.footer =
      "With --semantics closed what is taken away is open: what it leaves without area or volume is listed.\n"
      "Example: dymsum subtract plate.wkt hole.wkt slot.wkt -o part.json -o part.svg";
  verb.planar = [](std::span<const PlanarOperand> sets, const SumOptions& options) -> Result<PlanarSum> {
    const Result<PlanarSum> taken = united(sets.subspan(1), options);
    if (!taken) return taken;
    return difference(sets[0], *taken, options);
  };
  verb.solids = [](std::span<const SpatialOperand> solids, const SpatialOptions& options) {
    return difference(solids[0], solids.subspan(1), options);
  };
  verb.empty_is_no = true;
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
