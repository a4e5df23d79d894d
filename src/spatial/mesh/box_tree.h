// Axis-parallel boxes in a tree, to find pairs that overlap. Boxes are closed: touching ones overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(Vec3 v) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  void add(const Box& b) { add(b.low), add(b.high); }
  void grow(double r) {
    low = low - Vec3{r, r, r};
    high = high + Vec3{r, r, r};
  }
  Vec3 centre() const { return 0.5 * (low + high); }
  double size() const { return (high.x - low.x) + (high.y - low.y) + (high.z - low.z); }
};

inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// The boxes of triangles whose corners are off by at most `radius`.
std::vector<Box> boxes_of(const std::vector<Vec3>& at, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                          double radius);

/// The distance of a position from a box, to within some units in the last place of their coordinates.
inline double distance(const Box& box, Vec3 from) {
  const auto beyond = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  return length({beyond(box.low.x, box.high.x, from.x), beyond(box.low.y, box.high.y, from.y),
                 beyond(box.low.z, box.high.z, from.z)});
}

class BoxTree {
 public:
  struct Node {
    Box box;
    std::uint32_t left = 0, right = 0;  ///< of an inner node
    std::uint32_t first = 0, last = 0;  ///< of a leaf: a run of item()
    bool leaf() const { return last != 0; }
  };

  BoxTree() = default;
  /// The same tree, and the same order of all that it finds, for any number of threads and with any standard library.
  /// O(n log n).
  explicit BoxTree(std::vector<Box> boxes, int threads = 1);

  const Box& box(std::uint32_t i) const { return boxes_[i]; }
  bool empty() const { return nodes_.empty(); }
  const Box& bounds() const { return nodes_[0].box; }
  /// Node 0 is the root.
  const Node& node(std::uint32_t k) const { return nodes_[k]; }
  std::uint32_t item(std::uint32_t k) const { return order_[k]; }

  /// Calls f(i) for all boxes that overlap the given one.
  template <class F>
  void for_each(const Box& box, F f) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!overlap(node.box, box)) continue;
      if (node.leaf()) {
        for (std::uint32_t k = node.first; k < node.last; ++k)
          if (overlap(boxes_[order_[k]], box)) f(order_[k]);
      } else {
        stack[top++] = node.right;
        stack[top++] = node.left;
      }
    }
  }
  /// Does what any_pair does, with the boxes of the other tree reflected: a box B stands for the boxes at - B, for all
  /// positions `at`.
  template <class F>
  bool any_reflected_pair(const BoxTree& other, const Box& at, F f) const {
    const auto reflected = [&](const Box& b) { return Box{at.low - b.high, at.high - b.low}; };
    return any_overlap(other, reflected, f);
  }
  /// The same where a box B of the other tree stands for the boxes at - scale B. Requires scale > 0.
  template <class F>
  bool any_reflected_pair(const BoxTree& other, const Box& at, double scale, F f) const {
    const auto reflected = [&](const Box& b) { return Box{at.low - scale * b.high, at.high - scale * b.low}; };
    return any_overlap(other, reflected, f);
  }
  /// Calls f(i, j), i of this tree and j of the other one, for all pairs that overlap once j's boxes are moved by
  /// `shift`; stops where f says true, and returns whether it did.
  template <class F>
  bool any_pair(const BoxTree& other, F f) const {
    return any_overlap(
        other, [](const Box& b) { return b; }, f);
  }

 private:
  template <class M, class F>
  bool any_overlap(const BoxTree& other, M moved, F f) const {
    if (nodes_.empty() || other.nodes_.empty()) return false;
    std::vector<std::array<std::uint32_t, 2>> stack{{0, 0}};
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      const Node &na = nodes_[a], &nb = other.nodes_[b];
      if (!overlap(na.box, moved(nb.box))) continue;
      if (na.leaf() && nb.leaf()) {
        for (std::uint32_t k = na.first; k < na.last; ++k)
          for (std::uint32_t l = nb.first; l < nb.last; ++l)
            if (overlap(boxes_[order_[k]], moved(other.boxes_[other.order_[l]])) && f(order_[k], other.order_[l]))
              return true;
      } else if (nb.leaf() || (!na.leaf() && na.box.size() >= nb.box.size())) {
        stack.push_back({na.right, b}), stack.push_back({na.left, b});
      } else {
        stack.push_back({a, nb.right}), stack.push_back({a, nb.left});
      }
    }
    return false;
  }

  struct Interval {
    std::uint32_t node, first, last;  // of nodes_, of order_
  };
  std::uint32_t split(const Interval& interval);
  std::uint32_t build(const Interval& interval);

  static constexpr std::uint32_t kLeaf = 4;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace dymsum::spatial
