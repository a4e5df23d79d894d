// The position of a set that is furthest from the edges of another one.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/poll.h"
#include "check/convex_cells.h"
#include "check/edge_tree.h"

namespace dymsum::check {

struct Farthest {
  PointRef at;
  HomogeneousPoint nearest;  ///< of the edges
  Fraction squared;          ///< the square of the distance of both
  double at_most = 0;        ///< no position of the cells is further from all edges
  bool exact = true;         ///< nor further than `at`
};

/// Requires: cells, and edges. The distance from one edge is convex: no position of a cell is further from it than the
/// furthest of its vertices. Cells for which no edge proves that they are no further than what is known are cut where
/// two edges are equally far, the worst first. O(log n) for every cell.
Farthest farthest(std::vector<ConvexCell> cells, const EdgeTree& edges, const Poll& poll);

}  // namespace dymsum::check
