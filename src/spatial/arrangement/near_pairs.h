// Pairs of boxes that overlap, for all of them at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/convolution/stage_watch.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

// Arrays that grow faster than the operands: what they take counts with a StageWatch before it is there.

/// Gives back what was held. StageWatch counts modulo 2^64, so that this is the complement.
inline void give_back(std::size_t bytes, StageWatch& watch) { watch.hold(0 - static_cast<std::uint64_t>(bytes)); }

/// Adds a value; `bytes` for each come with the array, those of its own included. While it grows the old array is there
/// besides. Throws OverBudget.
template <class T>
void add_counted(std::vector<T>& array, const T& value, StageWatch& watch, std::size_t bytes = sizeof(T)) {
  if (array.size() == array.capacity()) {
    const std::size_t before = array.capacity(), room = std::max<std::size_t>(16, 2 * before);
    watch.hold(room * bytes);
    array.reserve(room);
    give_back(before * bytes, watch);
  }
  array.push_back(value);
}

/// Frees an array that grew by add_counted().
template <class T>
void free_counted(std::vector<T>& array, StageWatch& watch, std::size_t bytes = sizeof(T)) {
  const std::size_t room = array.capacity();
  std::vector<T>().swap(array);
  give_back(room * bytes, watch);
}

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

/// The pairs with a point in common of boxes of different groups: those of group k are boxes[first[k]] to
/// boxes[first[k + 1]]. Boxes that lie outside of all other groups' own are looked at once. O(n log n + k) for k pairs,
/// and the pairs of groups that overlap.
NearPairs near_pairs_between(std::span<const Box> boxes, std::span<const std::uint32_t> first, StageWatch& watch);

}  // namespace dymsum::spatial
