// The search for the nearest positions: free ones from a position in the open sum, ones of the sum from a position
// outside.
#pragma once

#include <vector>

#include "depth/depth_probe.h"
#include "depth/facet_lines.h"

namespace dymsum::depth {

struct NearestPositions {
  std::vector<ExactPosition> all;    ///< equally near and different; none where the time was over
  double at_most = 0, at_least = 0;  ///< scaled: bounds of the distance where the time was over
  SolidDistance::Work work;
};

/// docs/design/penetration-depth.md, "The search". `inside`: whether the position lies in the open sum.
NearestPositions nearest_positions(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside,
                                   double time_limit);

}  // namespace dymsum::depth
