// Whether points lie in a planar sum, for many points.
#include "dymsum/sum_locator.h"

#include "arrays.h"
#include "options.h"

namespace dymsum::web {
namespace {

std::shared_ptr<SumLocator> created(const PlanarSum& sum, const val& semantics) {
  return shared(SumLocator(sum, semantics_in(semantics)));
}
bool contains_point(const SumLocator& locator, const val& at) {
  return locator.contains_rational({rational_in(at["x"]), rational_in(at["y"])});
}
val contains_points(const SumLocator& locator, const val& coordinates, const val& progress) {
  return array_of(got(locator.contains_each(points_in(coordinates), 1, progress_in(progress))));
}

EMSCRIPTEN_BINDINGS(sum_locator) {
  handle<SumLocator>("SumLocator")
      .class_function("of", guarded<&created>)
      .function("contains", guarded<&contains_point>)
      .function("containsEach", guarded<&contains_points>);
}

}  // namespace
}  // namespace dymsum::web
