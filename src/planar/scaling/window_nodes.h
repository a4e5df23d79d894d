// What touches at every scale: ends of segments that stay on the lines of others, and the nodes they make.
#pragma once

#include <vector>

#include "planar/scaling/always_on.h"

namespace dymsum::planar {

/// Finds the touches of a window while its pairs are tested.
class TouchFinder {
 public:
  TouchFinder(Window& window, AlwaysOn& always_on) : window_(window), always_on_(always_on) {}

  /// Whether an end of one piece of a pair stays on the line of the other; then they touch there or not at all, and are
  /// no candidate.
  bool touch_always(const Candidate& c, std::array<bool, 2> at_a, std::array<bool, 2> at_b);
  /// Two parallel segments on one line at every scale: each end inside the other one touches it.
  void touch_parallel(std::uint32_t i, std::uint32_t j);
  /// Of every touch of the window, in order.
  const std::vector<WalkPair>& pairs() const { return pairs_; }

 private:
  void add_touch(std::uint32_t piece, WalkPair v, const Linear& t, double error);
  Window& window_;
  AlwaysOn& always_on_;
  std::vector<WalkPair> pairs_;
};

/// Touches grouped by their pair of vertices; segments through one node meet there only, so they are no candidates.
void make_nodes(Window& window, const std::vector<WalkPair>& touch_pairs);
/// Pieces pass and end in nodes that two edges prove covered throughout `swept` as if nothing touched: what begins or
/// ends in the open sum is false.
void drop_covered_nodes(Window& window, const WindowFrame& swept);

}  // namespace dymsum::planar
