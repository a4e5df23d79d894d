// Parts of rings that are the rings of what a set leaves out, reversed.
#pragma once

#include "dymsum/planar_sum.h"

namespace dymsum::planar {

/// Joins the rings of a result anew where they touch, so that every part has a connected interior, and brings the parts
/// into canonical form. Rings of a complement, reversed, bound the right set; but where they touch, they go
/// on across what it leaves out: a hole that touches its outline in several points is no hole, the interior falls apart
/// there. Requires: rings do not cross. Nothing changes where no hole touches another ring in two points.
/// Cost: O(n log n) for n vertices of a result with holes, with a sign for each vertex in the box of an edge.
void separate_parts(PlanarSum& sum);

}  // namespace dymsum::planar
