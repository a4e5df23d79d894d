// Files that list scaled copies of a master shape.
#pragma once

#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"

namespace dymsum::cli {

/// One line `scale x y` per copy: the master shape multiplied by an exact scale about the origin of its coordinates,
/// then moved to (x, y). Empty lines and everything after # are skipped. Stops with bad input, with file and line, for
/// anything else, and for a file without copies.
std::vector<ScaledCopy> read_copies(const std::string& file);

}  // namespace dymsum::cli
