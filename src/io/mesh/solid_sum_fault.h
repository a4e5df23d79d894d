// Whether lists that were read are those of a sum.
#pragma once

#include <optional>

#include "dymsum/spatial_sum.h"

namespace dymsum::io {

/// Why the lists are none of a sum, or nothing: vertices in the order of positions, each of some face or tight feature;
/// plane faces with area whose loops do not cross; and together the canonical boundary of a solid, shells named in
/// order: that of all positions whose winding number is positive is the same. Tight features are compared with nothing
/// else: they are plane, and in their order. Requires indices that are there, and loops of three vertices at least.
/// Exact. Errors: malformed, with a vertex or a face; out_of_range as parse_solid_sum.
std::optional<Error> solid_sum_fault(const SpatialSum& sum);

}  // namespace dymsum::io
