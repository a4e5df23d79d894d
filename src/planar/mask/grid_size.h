#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dymsum::planar {

/// Cells along the longer side of a sum for n segments: finer grids cost more in the mask than they save in pairs.
inline int grid_size(std::size_t n) {
  constexpr double kCellsPerRoot = 2;
  return std::clamp(static_cast<int>(kCellsPerRoot * std::sqrt(static_cast<double>(n))), 8, 1024);
}

}  // namespace dymsum::planar
