// The order of positions of a convex sum: by x, then y, then z.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_positions.h"

namespace dymsum::spatial {

/// The doubles nearest to the exact positions of vertices, infinite past the range of doubles.
std::vector<Point3> nearest_positions(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                      std::span<const ConvexSum::Vertex> vertices);

/// The indices of vertices with different positions by these positions, of which `nearest` are the nearest doubles.
/// Exact: where doubles are equal, what they leave out decides. O(n log n) comparisons of doubles.
std::vector<std::uint32_t> order_by_position(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                             std::span<const ConvexSum::Vertex> vertices,
                                             std::span<const Point3> nearest);

}  // namespace dymsum::spatial
