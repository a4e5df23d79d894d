// How far two boundaries are apart that do not cross.
#pragma once

#include <limits>
#include <optional>

#include "check/edge_tree.h"

namespace dymsum::check {

/// Two positions that are nearest to each other, on the boundaries of a and of b, which is moved.
struct Gap {
  PointRef of_a, of_b;
  Fraction squared;  ///< the square of their distance
};

/// The nearest ones are a vertex of one boundary and a position of an edge of the other one. Nothing where one is
/// empty, or where doubles prove that they are further apart than `reach`. Requires: they do not cross. Exact.
/// O((m + n) log(m + n)).
std::optional<Gap> gap_between(const EdgeTree& a, const EdgeTree& b, const HomogeneousPoint& b_moved_by,
                               double reach = std::numeric_limits<double>::infinity());

}  // namespace dymsum::check
