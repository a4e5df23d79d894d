// What of a part of a sum meets a ball.
#pragma once

#include "dymsum/local_sum.h"

namespace dymsum::spatial {

/// Drops the faces, tight faces, tight segments and tight points that do not meet the closed ball, and vertices that
/// then belong to nothing. Exact. O(n) in doubles, and exact distances where the ball's surface comes near.
void keep_in_ball(const ClipBall& ball, SpatialSum& part);

}  // namespace dymsum::spatial
