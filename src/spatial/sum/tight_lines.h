// Tight segments in line with each other put together.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "spatial/arrangement/point_table.h"

namespace dymsum::spatial {

/// Several pieces end to end on one line; `first` and `last` are the indices of those at its ends.
struct TightLine {
  PointId from = 0, to = 0;
  std::uint32_t first = 0, last = 0;
};

/// Pieces that share an end and lie on one line become one. Requires: pieces overlap in ends only. Exact. O(n log n)
/// for bounded numbers of pieces at a point.
std::vector<TightLine> joined_lines(const SumSpace& space, const PointTable& points,
                                    std::span<const std::array<PointId, 2>> pieces);

}  // namespace dymsum::spatial
