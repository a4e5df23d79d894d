// How obstacles of all orientations grow with shapes whose events coincide or crowd: time and work.
#pragma once

#include <iosfwd>
#include <string>

#include "coordinate_kinds.h"

namespace dymsum::bench {

/// Polygons of about 25, 50, 100 and 200 vertices (stars: up to 100) as robot and as obstacle; prints a table, and
/// writes it to DIR/cspace-growth.md unless DIR is empty. A polygon that rounding spoils has a row that says so. False
/// where that cannot be written.
bool measure_obstacle_growth(Kind kind, const std::string& dir, std::ostream& out);

}  // namespace dymsum::bench
