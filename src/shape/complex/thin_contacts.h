// Polylines and points that touch something else: the walks of the boundary know none of these.
#pragma once

#include <optional>

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::shape {

/// unsupported_operand, with the position, where a polyline or a point meets a part, another polyline or point, or
/// itself but for neighbouring segments and the ends of a closed polyline; lying inside a part counts. Exact. O(n log
/// n) for n segments of which few lie above each other, and O(n) for every polyline and point that parts surround.
std::optional<Error> thin_contact(const Region& region);

}  // namespace dymsum::shape
