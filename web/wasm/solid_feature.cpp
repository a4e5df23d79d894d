#include "solid_feature.h"

namespace dymsum::web {

void add(std::vector<std::uint32_t>& numbers, const SolidFeature& feature) {
  numbers.insert(numbers.end(), {static_cast<std::uint32_t>(feature.kind), feature.a, feature.b});
}

}  // namespace dymsum::web
