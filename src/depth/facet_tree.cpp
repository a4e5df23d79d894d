#include "depth/facet_tree.h"

#include <algorithm>
#include <numeric>

namespace dymsum::depth {

using spatial::Box;
using spatial::Vec3;

namespace {

constexpr std::uint32_t kLeafSize = 4;

double coordinate(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

double distance(const Box& box, Vec3 from) {
  const auto beyond = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  return spatial::length({beyond(box.low.x, box.high.x, from.x), beyond(box.low.y, box.high.y, from.y),
                          beyond(box.low.z, box.high.z, from.z)});
}

FacetTree::FacetTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t FacetTree::build(std::uint32_t first, std::uint32_t last) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box, centres;
  for (std::uint32_t k = first; k < last; ++k) box.add(boxes_[order_[k]]), centres.add(boxes_[order_[k]].centre());
  nodes_[id].box = box;
  if (last - first <= kLeafSize) {
    nodes_[id].first = first, nodes_[id].last = last;
    return id;
  }
  const Vec3 size = centres.high - centres.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double u = coordinate(boxes_[a].centre(), axis), v = coordinate(boxes_[b].centre(), axis);
                     return u != v ? u < v : a < b;
                   });
  const std::uint32_t left = build(first, half), right = build(half, last);
  nodes_[id].left = left, nodes_[id].right = right;
  return id;
}

}  // namespace dymsum::depth
