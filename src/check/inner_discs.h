// Discs inside a shape: two shapes overlap where discs of theirs do, which is seen at once.
#pragma once

#include <optional>
#include <vector>

#include "check/edge_tree.h"

namespace dymsum::check {

/// Open discs that lie inside a set, the largest first: a few of those about the centres of its convex cells.
class InnerDiscs {
 public:
  InnerDiscs(const PlanarSum& set, const EdgeTree& edges);
  /// Those of the set turned about the origin, a little smaller.
  InnerDiscs turned(double radians) const;

  /// A position in discs of both, of the second set moved by (dx, dy), where doubles prove that there is one.
  friend std::optional<Point> common_position(const InnerDiscs& a, const InnerDiscs& b, const Interval& dx,
                                              const Interval& dy);

 private:
  struct Disc {
    Point centre;
    double radius;
  };
  std::vector<Disc> discs_;
};

std::optional<Point> common_position(const InnerDiscs& a, const InnerDiscs& b, const Interval& dx, const Interval& dy);

}  // namespace dymsum::check
