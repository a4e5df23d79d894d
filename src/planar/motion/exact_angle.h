// Algebraic angles as values: their exact order in (-pi, pi], doubles that enclose them, and orientations between them.
#pragma once

#include "dymsum/cspace_obstacle.h"
#include "exact/algebraic_root.h"

namespace dymsum::planar {

/// An angle as a root in one of two charts, so that half turns need no exception: theta = 2 atan(t) + pi chart, t in
/// (-1, 1]. Chart 0 covers (-pi/2, pi/2], chart 1 the rest.
struct ExactAngle {
  int chart = 0;
  exact::AlgebraicRoot t;
};

/// The angle of an orientation. Exact.
ExactAngle exact_angle(const Orientation& theta);

/// The sign of a - b, both in (-pi, pi]. Exact; doubles decide where the roots' own bounds are apart.
int compare(const ExactAngle& a, const ExactAngle& b);

/// What is public of an angle: the doubles enclose it, being equal only for 0; `exact` is set where the tangent of the
/// half angle is rational.
EventAngle event_angle(const ExactAngle& angle);

/// An orientation strictly inside the way from a counter-clockwise to b, the whole turn without a when they are equal:
/// a multiple of a quarter turn if there is one, else n / 2^k in the chart of the angles with the smallest k.
Orientation orientation_between(const ExactAngle& a, const ExactAngle& b);

}  // namespace dymsum::planar
