// Operands whose common grid has more bits than a space of sums holds.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// What a space of sums needs: bits on the axis that needs most, and the vertex of either list that has the smallest
/// unit there.
struct GridNeed {
  int bits = 0;
  char axis = 'x';
  std::size_t vertex = 0;
  Point3 at;
};
/// Requires: both have vertices.
GridNeed grid_need(const std::vector<Point3>& p, const std::vector<Point3>& q);

/// unsupported_operand, with the vertex whose coordinate has the smallest unit on the axis that needs most bits;
/// nothing where kMostGridBits do. Requires: both have vertices.
std::optional<Error> grid_error(const std::vector<Point3>& p, const std::vector<Point3>& q);

}  // namespace dymsum::spatial
