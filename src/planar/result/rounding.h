// The one place where an exact sum becomes doubles.
#pragma once

#include "dymsum/planar_sum.h"
#include "dymsum/snap_rounding.h"

namespace dymsum::planar {

/// The set of a sum (parts, segments as polylines, points) with every vertex correctly rounded to doubles.
///
/// Where a vertex lies exactly inside an edge it does not belong to, and rounding moves it off that edge, the edge is
/// bent by an additional vertex there, so that the contact stays. Every edge of the result stays as close to the exact
/// one as rounding moves vertices.
///
/// Checked, exactly, so that it holds of every result:
///  - all coordinates are finite;
///  - vertices are equal after rounding exactly when they were equal before;
///  - a vertex lies on an edge after rounding exactly when it did before;
///  - a segment of the set and another segment or an edge of a ring cross exactly when they did before;
///  - the result is valid (Region::create): no rings cross, orientation and nesting of holes are right, parts share no
///    interior points.
/// Error rounding_changed_topology otherwise, with part, ring and vertex numbers of the sum where rings are concerned,
/// and the position. Not checked: that a part smaller than the rounding lies in the same hole of another part as
/// before. Cost: O(n log n + m) for n vertices and m pairs of edge and vertex with overlapping x ranges, exact
/// arithmetic on the pairs that doubles do not distinguish; O(s n) for s segments.
Result<Region> rounded(const PlanarSum& sum);

/// rounded() where it has an answer, and snapped_rings() of the nearest doubles otherwise. What moves: vertices by half
/// a unit in the last place of the largest x and y, cuts of edges by the distance of a crossing from its nearest
/// doubles, and so on for cuts of what was cut, along each edge added up.
Result<SnapRounded> snap_rounded(const PlanarSum& sum);

/// Rounds as rounded() does and promises nothing but validity of the result: vertices that collide are merged, rings
/// that collapse are dropped, segments that collapse become points, all by dymsum::repair, which also drops vertices
/// that rounding made collinear; the report counts everything, equal points as duplicate vertices. Error
/// rounding_changed_topology where coordinates are not finite or the repaired data are still not valid.
Result<Repaired> rounded_with_repair(const PlanarSum& sum);

}  // namespace dymsum::planar
