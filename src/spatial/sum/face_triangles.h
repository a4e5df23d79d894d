// Faces of a solid sum split into triangles.
#pragma once

#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// Every face as triangles of its own vertices, counter-clockwise seen from outside, each with area: all edges of the
/// loops once, all others twice. Exact. O(n^2) for a face of n vertices, and O(n) more for each hole.
Triangles triangulated(const SpatialSum& sum);

}  // namespace dymsum::spatial
