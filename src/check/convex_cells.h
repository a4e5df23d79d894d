// A set of the plane cut into convex cells.
#pragma once

#include <vector>

#include "check/exact_point.h"
#include "dymsum/planar_sum.h"

namespace dymsum::check {

/// A convex polygon, counter-clockwise; of two vertices a segment, of one a point. Where a cell is cut, new vertices
/// lie on two lines that were there: their digits do not grow from cut to cut.
struct ConvexCell {
  std::vector<PointRef> vertices;
  std::vector<std::shared_ptr<const Line>> lines;  ///< from each vertex to the next one
};

/// Parts as trapezoids between vertical lines through their vertices, then segments and points. Exact. O((n + c) log n)
/// for n vertices of the set, where a vertical line meets c edges at most.
std::vector<ConvexCell> convex_cells(const PlanarSum& set);

/// Both sides of a cell beside a line that does not miss its inside.
struct HalvedCell {
  ConvexCell negative, positive;
};
HalvedCell halved(const ConvexCell& cell, Line line);

}  // namespace dymsum::check
