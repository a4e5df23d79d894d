// The positions of a sum's boundary, tight features included, that are nearest to a position: all faces in exact
// arithmetic, the reference; or those alone that doubles do not prove to be further away.
#pragma once

#include <array>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"

namespace dymsum::depth {

using RationalVector = std::array<exact::BigRational, 3>;

/// Relative to the position, different, in any order. O(n) for n vertices of faces.
std::vector<RationalVector> nearest_on_boundary(const SpatialSum& sum, const RationalVector& from);

struct NearestOnBoundary {
  std::vector<RationalVector> all;      ///< as of nearest_on_boundary
  std::size_t faces = 0, segments = 0;  ///< that doubles left open, of which exact numbers decide
};
NearestOnBoundary nearest_by_doubles_first(const SpatialSum& sum, const RationalVector& from);

}  // namespace dymsum::depth
