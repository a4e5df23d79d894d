// Faces of a solid sum split into triangles.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// Every face as triangles of its own vertices, counter-clockwise seen from outside, each with area: all edges of the
/// loops once, all others twice. Exact. O(n^2) for a face of n vertices, and O(n) more for each hole.
Triangles triangulated(const SpatialSum& sum);

/// The first face that has none, as its loops cross or have no area; tight faces are counted after the others. Requires
/// plane faces of vertices in the order of positions, nothing else of what a sum is.
std::optional<std::size_t> first_without_triangles(const SpatialSum& sum);

}  // namespace dymsum::spatial
