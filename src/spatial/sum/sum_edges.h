// The edges of a sum's faces.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

// The vertex at which a loop of a face begins.

/// Rotates the loop to its smallest rotation: it begins at its smallest vertex; where it comes by that several times,
/// at the visit after which it goes on smallest.
void start_at_smallest(std::vector<std::uint32_t>& loop);

/// All edges with the faces that they bound, sorted; without contacts. O(n log n).
std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces);

}  // namespace dymsum::spatial
