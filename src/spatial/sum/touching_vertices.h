// Vertices of a sum that touch a face inside it: its triangles have to have them as corners, too.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// The triangles of a sum's faces, those that a vertex touches inside, or on a side that is no edge of the sum, split
/// there. Exact. O(n log n), and exact comparisons for the triangles near a vertex of others.
Triangles split_at_touching_vertices(const SpatialSum& sum, Triangles triangles);

}  // namespace dymsum::spatial
