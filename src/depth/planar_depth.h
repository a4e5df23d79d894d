// The positions of the boundary of a planar sum, tight features included, that are nearest to a position, exactly.
#pragma once

#include <array>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "exact/big.h"

namespace dymsum::depth {

using PlaneVector = std::array<exact::BigRational, 2>;

struct PlaneNearest {
  /// Inside the open sum, on its boundary, off the closed one.
  Meeting meeting = Meeting::apart;
  exact::BigRational squared;      ///< of the distance
  std::vector<PlaneVector> moves;  ///< to all nearest positions, sorted, each once; none where there is no boundary
};
PlaneNearest nearest_on_boundary(const PlanarSum& sum, const RationalPoint& position);

}  // namespace dymsum::depth
