// Points in the order of their coordinates, and which of them are at one position.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// The indices of all points by x, then y, then z; those at one position by index. O(n log n).
std::vector<std::uint32_t> order_by_position(const std::vector<Point3>& points);

/// The first of the points at every one's position. O(n log n).
std::vector<std::uint32_t> first_at_position(const std::vector<Point3>& points);

}  // namespace dymsum::spatial
