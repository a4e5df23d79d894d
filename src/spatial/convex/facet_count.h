// How many facets a sum has, without making it.
#pragma once

#include "dymsum/convex_sum.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// Those that `assemble` makes. Requires operands whose coplanar faces are merged. O(faces and crossings).
ConvexSum::FacetCount count_facets(const Overlay& overlay);

}  // namespace dymsum::spatial
