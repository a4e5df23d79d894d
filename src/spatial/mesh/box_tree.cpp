#include "spatial/mesh/box_tree.h"

#include <numeric>

namespace dymsum::spatial {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (boxes_.empty()) return;
  nodes_.reserve(boxes_.size());
  build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t first, std::uint32_t last) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box, middles;
  for (std::uint32_t k = first; k < last; ++k) {
    box.add(boxes_[order_[k]]);
    middles.add(boxes_[order_[k]].middle());
  }
  nodes_[id].box = box;
  if (last - first <= kLeaf) {
    nodes_[id].first = first, nodes_[id].last = last;
    return id;
  }
  const Vec3 extent = middles.high - middles.low;
  double Vec3::*axis = extent.x >= extent.y && extent.x >= extent.z ? &Vec3::x
                       : extent.y >= extent.z                       ? &Vec3::y
                                                                    : &Vec3::z;
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = boxes_[a].middle().*axis, y = boxes_[b].middle().*axis;
                     return x != y ? x < y : a < b;
                   });
  const std::uint32_t left = build(first, half), right = build(half, last);
  nodes_[id].left = left, nodes_[id].right = right;
  return id;
}

}  // namespace dymsum::spatial
