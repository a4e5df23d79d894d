// How far shapes reach in some directions, and by that how deep two of them can be in each other.
#pragma once

#include <array>

#include "check/edge_tree.h"

namespace dymsum::check {

/// The largest coordinates along 32 directions, each at least the exact one.
class Extent {
 public:
  explicit Extent(const EdgeTree& edges);

  /// An upper bound of the penetration depth of a and of b moved by (dx, dy): the shortest of the moves in these
  /// directions after which a line separates them.
  friend double depth_bound(const Extent& a, const Extent& b, const Interval& dx, const Interval& dy);

 private:
  static constexpr int kDirections = 32;
  std::array<double, kDirections> high_{};
  double reach_ = 0;
};

double depth_bound(const Extent& a, const Extent& b, const Interval& dx, const Interval& dy);

}  // namespace dymsum::check
