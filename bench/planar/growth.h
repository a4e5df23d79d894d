// How sums of ever larger operands grow: time, work and memory.
#pragma once

#include <iosfwd>
#include <string>

#include "coordinate_kinds.h"

namespace dymsum::bench {

/// Random stars of 250 to `largest` vertices with themselves, and a circle of jittered vertices with a polygon; prints
/// a table, and writes it to DIR/growth.md unless DIR is empty. A shape that rounding spoils has a row that says so.
/// False where that cannot be written.
bool measure_growth(int largest, Kind kind, const std::string& dir, std::ostream& out);

}  // namespace dymsum::bench
