// The position of a solid that is furthest from the boundary of another one.
#pragma once

#include "base/poll.h"
#include "check/near_triangles.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::check {

struct FarthestInSolid {
  RationalVector at;
  NearTriangles::Nearest nearest;  ///< of the triangles
  double at_most = 0;              ///< no position of the solid is further from all triangles
  bool exact = true;               ///< nor further than `at`
};

/// Requires: the solid has volume. `convex`: the distance is convex over the solid, so that a vertex is furthest. Else
/// the box around the solid is cut into convex cells, the worst first: at its faces, where these cross the cell, and
/// where two triangles are equally far. The distance from one triangle is convex: no position of a cell is further from
/// it than the furthest vertex of the cell. Cells outside of the solid, and those for which a triangle proves that they
/// are no further than what is known, are done.
FarthestInSolid farthest_in_solid(const SpatialSum& set, const NearTriangles& triangles, bool convex, const Poll& poll);

}  // namespace dymsum::check
