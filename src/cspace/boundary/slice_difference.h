// What lies between the boundary before an angle and a whole slice after it.
#pragma once

#include <functional>

#include "cspace/boundary/boundary_graph.h"

namespace dymsum::planar {

/// A loop of a slice: its segments, by index, in order.
struct SliceLoop {
  std::vector<std::uint32_t> segments;
  bool outer = false;
};

/// The edit, without `continued`. Nodes with the same segment and neighbours stay, but for those that are `parted`:
/// they end, and touch what begins in their place. O(n log n).
SliceEdit slice_difference(const BoundaryGraph& before, const std::vector<SliceLoop>& after,
                           const std::function<bool(std::uint32_t)>& parted);

}  // namespace dymsum::planar
