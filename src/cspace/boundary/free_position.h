// Whether the robot touches the obstacle without overlapping it, at a position and an angle that are algebraic numbers.
#pragma once

#include "cspace/events/exact_position.h"

namespace dymsum::planar {

/// True if and only if the open obstacle does not hold z at the angle: the interiors of O and of R, turned and moved,
/// have no point in common. O(nm) comparisons of doubles; exact signs for pairs of edges that are not clearly apart.
bool is_free(const SignsAt& signs, const ExactPosition& z);

}  // namespace dymsum::planar
