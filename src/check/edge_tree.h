// The segments that bound a set, and those of them that are nearest to a position.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "check/exact_point.h"
#include "dymsum/planar_sum.h"

namespace dymsum::check {

/// Edges of rings, segments and points of a set.
std::vector<Segment> edges_of(const PlanarSum& set);

/// A tree of boxes. O(n log n).
class EdgeTree {
 public:
  explicit EdgeTree(std::vector<Segment> edges);

  bool empty() const { return edges_.empty(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(edges_.size()); }
  const Segment& operator[](std::uint32_t edge) const { return edges_[edge]; }
  /// An edge that is nearest as far as doubles know. Requires: not empty.
  std::uint32_t rough_nearest(Point p) const;
  double rough_distance(Point p) const { return check::rough_distance(p, edges_[rough_nearest(p)]); }
  /// What rough distances of vertices of both are off by at most, one of which is moved.
  double slack(const EdgeTree& other, const ExactPoint& move) const {
    return slack_of(reach_ + other.reach_ + std::abs(move.near.x) + std::abs(move.near.y));
  }
  struct Nearest {
    Fraction squared;
    std::uint32_t edge = 0;
  };
  /// A nearest one, exactly: of all that doubles do not prove to be further away.
  Nearest nearest(const ExactPoint& p) const;

 private:
  struct Node {
    Point low, high;
    std::uint32_t first, last, right;  // its edges; its right child, the left one follows it; of a leaf 0
  };
  /// Rough distances are off by some ulps of the coordinates.
  static double slack_of(double reach) { return 0x1p-40 * reach + 0x1p-1060; }
  void add_node(std::uint32_t first, std::uint32_t last);
  /// Edges that are at most `slack` further than the nearest, roughly.
  void collect(Point p, double slack, double& best, std::vector<std::pair<double, std::uint32_t>>& found) const;

  std::vector<Segment> edges_;
  std::vector<Node> nodes_;
  double reach_ = 0;  // the largest coordinate
};

}  // namespace dymsum::check
