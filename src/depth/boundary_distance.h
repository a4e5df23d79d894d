// The positions of a sum's boundary, tight features included, that are nearest to a place: all faces in exact
// arithmetic, the reference.
#pragma once

#include <array>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"

namespace dymsum::depth {

using RationalVector = std::array<exact::BigRational, 3>;

/// Relative to the place, different, in any order. O(n) for n vertices of faces.
std::vector<RationalVector> nearest_on_boundary(const SpatialSum& sum, const RationalVector& from);

}  // namespace dymsum::depth
