// Boolean operations on regions and planar sums.
#include "dymsum/planar_boolean.h"

#include <vector>

#include "planar_operand.h"

namespace dymsum::web {
namespace {

using emscripten::function;

std::shared_ptr<PlanarSum> union_of_sets(const val& sets, const val& options) {
  std::vector<TakenOperand> taken;
  const auto n = sets["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) taken.emplace_back(sets[k]);
  return shared(got(united(std::vector<PlanarOperand>(taken.begin(), taken.end()), sum_options(options))));
}

EMSCRIPTEN_BINDINGS(planar_boolean) {
  function("united", guarded<&union_of_sets>);
  function("intersection", guarded<&of_sets<&intersection>>);
  function("difference", guarded<&of_sets<&difference>>);
  function("symmetricDifference", guarded<&of_sets<&symmetric_difference>>);
}

}  // namespace
}  // namespace dymsum::web
