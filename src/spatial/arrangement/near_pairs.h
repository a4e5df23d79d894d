// Pairs of boxes that overlap, for all of them at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spatial/convolution/stage_watch.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

/// Pairs of boxes, those of f with larger ones being others[begin[f]] to others[begin[f + 1]], ascending.
struct NearPairs {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> others;

  std::span<const std::uint32_t> of(std::size_t f) const { return {others.data() + begin[f], begin[f + 1] - begin[f]}; }
};

/// All pairs of boxes with a point in common. Requires finite coordinates. O(n log n + k) for k pairs where boxes are
/// small beside what they lie in. Leaves of sixteen are compared in floats that hold the boxes, which halves what a
/// walk down a tree for each box takes.
NearPairs near_pairs(std::span<const Box> boxes, StageWatch& watch);

}  // namespace dymsum::spatial
