// --lines: regions by their lines.
#pragma once

#include <string>
#include <vector>

#include "inputs.h"

namespace dymsum::cli {

/// Regions with their edges as they were meant, with axes in common where that does; exact results as they are.
std::vector<Input> read_by_lines(const std::vector<std::string>& files, const InputOptions& options);

}  // namespace dymsum::cli
