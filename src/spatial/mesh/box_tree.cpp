#include "spatial/mesh/box_tree.h"

#include <numeric>

#include "base/parallel.h"

namespace dymsum::spatial {

namespace {

/// The number of nodes of a tree over so many boxes. Both halves of equal sizes have equally many: O(log^2 n).
std::uint32_t node_count(std::uint32_t boxes, std::uint32_t leaf) {
  if (boxes <= leaf) return 1;
  const std::uint32_t half = boxes / 2;
  return 1 + (2 * half == boxes ? 2 * node_count(half, leaf) : node_count(half, leaf) + node_count(half + 1, leaf));
}

}  // namespace

std::vector<Box> boxes_of(const std::vector<Vec3>& at, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                          double radius) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) boxes[t].add(at[v]);
    boxes[t].grow(radius);
  }
  return boxes;
}

BoxTree::BoxTree(std::vector<Box> boxes, int threads) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (boxes_.empty()) return;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  nodes_.resize(node_count(count, kLeaf));
  std::vector<Interval> intervals{{0, 0, count}};
  constexpr std::uint32_t kFew = 2048;
  for (int level = 0; threads != 1 && count > kFew && level < 3; ++level) {
    std::vector<Interval> halves(2 * intervals.size());
    base::parallel_parts(intervals.size(), threads, [&](std::size_t k) {
      const Interval& s = intervals[k];
      const std::uint32_t half = split(s);
      Node& node = nodes_[s.node];
      node.left = s.node + 1, node.right = node.left + node_count(half - s.first, kLeaf);
      halves[2 * k] = {node.left, s.first, half}, halves[2 * k + 1] = {node.right, half, s.last};
    });
    intervals.swap(halves);
  }
  base::parallel_parts(intervals.size(), threads, [&](std::size_t k) { build(intervals[k]); });
}

/// Sets the box of a node; returns where its second half begins, or the end of a leaf.
std::uint32_t BoxTree::split(const Interval& s) {
  Box box, centres;
  for (std::uint32_t k = s.first; k < s.last; ++k) {
    box.add(boxes_[order_[k]]);
    centres.add(boxes_[order_[k]].centre());
  }
  nodes_[s.node].box = box;
  if (s.last - s.first <= kLeaf) return s.last;
  const Vec3 extent = centres.high - centres.low;
  double Vec3::*axis = extent.x >= extent.y && extent.x >= extent.z ? &Vec3::x
                       : extent.y >= extent.z                       ? &Vec3::y
                                                                    : &Vec3::z;
  const std::uint32_t half = s.first + (s.last - s.first) / 2;
  std::nth_element(order_.begin() + s.first, order_.begin() + half, order_.begin() + s.last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = boxes_[a].centre().*axis, y = boxes_[b].centre().*axis;
                     return x != y ? x < y : a < b;
                   });
  return half;
}

/// Returns the node after its last one.
std::uint32_t BoxTree::build(const Interval& s) {
  const std::uint32_t half = split(s);
  Node& node = nodes_[s.node];
  if (half == s.last) {
    // How nth_element leaves them differs from library to library.
    std::sort(order_.begin() + s.first, order_.begin() + s.last);
    node.first = s.first, node.last = s.last;
    return s.node + 1;
  }
  node.left = s.node + 1;
  node.right = build({node.left, s.first, half});
  return build({node.right, half, s.last});
}

}  // namespace dymsum::spatial
