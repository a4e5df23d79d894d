// What lies in the sums of a ScalingFamily at some scale, and at every one.
#include "options.h"
#include "scaling_family.h"

namespace dymsum::web {
namespace {

std::shared_ptr<PlanarSum> outer_set(const ScalingFamily& family, const val& from, const val& to) {
  return shared(got(family.outer(scale_in(from), scale_in(to))));
}
std::shared_ptr<PlanarSum> inner_set(const ScalingFamily& family, const val& from, const val& to) {
  return shared(got(family.inner(scale_in(from), scale_in(to))));
}

EMSCRIPTEN_BINDINGS(family_sets) {
  scaling_family_handle().function("outer", guarded<&outer_set>).function("inner", guarded<&inner_set>);
}

}  // namespace
}  // namespace dymsum::web
