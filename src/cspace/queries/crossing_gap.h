// How far a line of the obstacle and a line that turns with the robot are apart while they are parallel: zero is
// determined exactly, anything else keeps its relative accuracy. Near such an angle their crossing runs along the lines
// as the quotient of this distance and the angle.
#pragma once

#include <array>

#include "base/doubles.h"
#include "dymsum/region.h"

namespace dymsum::cspace {

using base::DoublePair;

/// The gaps, for unit vectors u along the fixed edge and m along the rotating one and any corner of theirs that moves
/// along: cross(corner_of_fixed - fixed start, u) +- cross(turning start - corner_of_turning, m); the plus sign first,
/// which stands for equal directions. `corner` is the obstacle's vertex on the turning line, `hand` the robot's on the
/// fixed one. They are within 2^-50 of the value, or 2^-90 of the largest coordinate where those span more than 2^100.
using CrossingGaps = std::array<double, 2>;
CrossingGaps crossing_gaps(const std::array<Point, 2>& fixed, const std::array<Point, 2>& turning, Point corner,
                           Point hand);

/// tan(phi / 2) of the angle from a to b, and of that angle less half a turn: each within 2^-98 where it is at most 1.
std::array<DoublePair, 2> half_tangents(const std::array<Point, 2>& a, const std::array<Point, 2>& b);

}  // namespace dymsum::cspace
