// Features of solids and what touches.
#pragma once

#include <cstdint>
#include <vector>

#include "bind.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::web {

/// {kind, a, b}
val solid_feature(const SolidFeature& feature);
/// {p, q}
val solid_contact(const SolidContact& contact);
/// Three numbers: kind, a, b.
void add(std::vector<std::uint32_t>& numbers, const SolidFeature& feature);

}  // namespace dymsum::web
