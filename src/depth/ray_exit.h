// The first free position on a ray from a position in the open sum.
#pragma once

#include "depth/boundary_distance.h"
#include "depth/depth_probe.h"
#include "depth/facet_lines.h"

namespace dymsum::depth {

/// The least s with from + s direction free. Candidates are where the ray crosses planes of facets near it, and facet
/// edges of those in whose planes it runs (docs/design/penetration-depth.md, "Along a direction").
BigRational exit_along(const FacetView& view, const ExactFrame& frame, DepthProbe& probe,
                       const RationalVector& direction, const RationalVector& from);

}  // namespace dymsum::depth
