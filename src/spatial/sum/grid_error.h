// Operands whose common grid has more bits than a space of sums holds.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"

namespace dymsum::spatial {

/// unsupported_operand, with the vertex whose coordinate has the smallest unit on the axis that needs most bits;
/// nothing where 250 bits do. Requires: both have vertices.
std::optional<Error> grid_error(const std::vector<Point3>& p, const std::vector<Point3>& q);

}  // namespace dymsum::spatial
