// Boxes of facets in a tree, for searches from the nearest on.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

/// The distance from a position to a box, to within some units in the last place of their coordinates.
double distance(const spatial::Box& box, spatial::Vec3 from);

class FacetTree {
 public:
  struct Node {
    spatial::Box box;
    std::uint32_t left = 0, right = 0;  ///< of an inner node
    std::uint32_t first = 0, last = 0;  ///< of a leaf: a run of order()
    bool leaf() const { return last != 0; }
  };

  FacetTree() = default;
  explicit FacetTree(std::vector<spatial::Box> boxes);

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t k) const { return nodes_[k]; }
  std::uint32_t item(std::uint32_t k) const { return order_[k]; }
  const spatial::Box& box(std::uint32_t item) const { return boxes_[item]; }

  /// Calls f(i) for all boxes that overlap the given one.
  template <class F>
  void for_each(const spatial::Box& box, F f) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!spatial::overlap(node.box, box)) continue;
      if (node.leaf()) {
        for (std::uint32_t k = node.first; k < node.last; ++k)
          if (spatial::overlap(boxes_[order_[k]], box)) f(order_[k]);
      } else {
        stack[top++] = node.right;
        stack[top++] = node.left;
      }
    }
  }

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<spatial::Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace dymsum::depth
