// Finds the points that lie on segments and points of a set: a tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/position/near_spot.h"

namespace dymsum::planar {

/// A closed segment; both ends equal: a point.
struct Feature {
  NearSpot from, to;
};

/// Features may cross and overlap. Exact. O(n log n) to make; a question looks at the features in whose boxes the point
/// lies, and at O(log n) others where boxes are apart.
class FeatureTree {
 public:
  FeatureTree() = default;
  /// Requires: what the ends refer to outlives this.
  explicit FeatureTree(std::vector<Feature> features);

  bool holds(const NearSpot& z) const;

 private:
  struct Node {
    Point low, high;
    std::uint32_t first, last;  // its features
    std::uint32_t after;        // the node that follows when this one's box does not hold a point
    bool leaf;
  };
  void add_node(std::uint32_t first, std::uint32_t last);

  std::vector<Feature> features_;
  std::vector<Node> nodes_;  // each before its two children
};

}  // namespace dymsum::planar
