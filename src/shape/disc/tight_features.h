// Positions of a disc that has no room: nodes and flat edges of exactly the radius at hand.
#pragma once

#include "shape/disc/disc_positions.h"

namespace dymsum::shape {

struct TightFeatures {
  std::vector<DiscSegment> segments;  ///< maximal
  std::vector<DiscCorner> points;     ///< that belong to no segment
};

/// What of { d >= r } is not in the closure of { d > r }. O(n).
TightFeatures tight_features(const DiscPositions& positions);

}  // namespace dymsum::shape
