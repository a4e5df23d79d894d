// Euler numbers of the shells of a sum.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// V - E + F of every shell, sorted; a face with h holes counts 1 - h. Where shells, or parts of one, touch in a vertex
/// or along an edge, it counts once for each of the surfaces that go on there: faces go together that bound one wedge
/// of the outside. So 2 - 2 g for a shell of genus g. Exact. O(n log n).
std::vector<std::int64_t> shell_euler_numbers(const SpatialSum& sum);

}  // namespace dymsum::spatial
