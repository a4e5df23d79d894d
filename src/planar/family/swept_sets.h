// What lies in a family's sum at some scale of an interval, and what lies in it at every scale.
#pragma once

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "planar/family/scaling_cells.h"

namespace dymsum::planar {

/// The union of diag(x s, y s) times a region for s in [a, b], exact and closed. Each point runs along a ray from the
/// origin, so it is the region at both ends with a quadrangle for every edge. Requires: 0 < a <= b; parts only. Errors:
/// as Boolean operations.
Result<PlanarSum> swept_region(const Region& region, const Factors& factors, const exact::BigRational& a,
                               const exact::BigRational& b);

/// The closure of the interior of the intersection of a family's sums at t in [a, b], t as the path has it; `first` is
/// the one at a. An interior point of `first` leaves the intersection where an edge of the boundary passes it. Edges
/// keep their directions, so what one passes is a quadrangle, from its first position to its last one. Requires: the
/// structures in between are kept. Errors: as Boolean operations.
Result<PlanarSum> common_set(const ScalingCells& cells, const PlanarSum& first, const exact::BigRational& a,
                             const exact::BigRational& b);

}  // namespace dymsum::planar
