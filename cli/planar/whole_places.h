// Positions in fractions, for questions that are asked in doubles: robot, obstacle and positions are taken so many
// times as large that the positions are doubles. Angles stay as they are, and lengths are divided again.
#pragma once

#include <vector>

#include "dymsum/rational.h"
#include "planar/obstacle_input.h"

namespace dymsum::cli {

/// The common denominator of all positions, but for powers of two; 1 where they are doubles. Stops with bad input where
/// that many times a position is no double.
Rational times_for(const std::vector<RationalPoint>& positions);

/// Robot and obstacle so many times as large; an obstacle that was read is to be made again. Stops with bad input that
/// names the operand where a coordinate is no double then.
void enlarge(ObstacleSource& source, const Rational& times);

/// The position so many times as far. Requires: times of times_for.
Point enlarged(const RationalPoint& position, const Rational& times);

}  // namespace dymsum::cli
