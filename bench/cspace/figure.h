// A picture of an obstacle of all orientations, after figure 4.4 of the thesis.
#pragma once

#include <string>

#include "dymsum/cspace_obstacle.h"

namespace dymsum::bench {

/// SVG text: on the left the slice at orientation 0 around the obstacle; on the right the boundary as a solid in (x, y,
/// theta), theta upwards, seen from above in parallel projection, its patches drawn from the farthest to the nearest,
/// fixed ones light and rotating ones dark, covered by the slice at half a turn.
std::string draw_obstacle(const CspaceObstacle& obstacle, const std::string& title);

}  // namespace dymsum::bench
