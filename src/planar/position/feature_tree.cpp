#include "planar/position/feature_tree.h"

#include <algorithm>

namespace dymsum::planar {

FeatureTree::FeatureTree(std::vector<Feature> features) : features_(std::move(features)) {
  if (!features_.empty()) add_node(0, static_cast<std::uint32_t>(features_.size()));
}

void FeatureTree::add_node(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  Point low = features_[first].from.at, high = low;
  for (std::uint32_t k = first; k < last; ++k)
    for (const NearSpot& end : {features_[k].from, features_[k].to}) {
      low = {std::min(low.x, end.at.x), std::min(low.y, end.at.y)};
      high = {std::max(high.x, end.at.x), std::max(high.y, end.at.y)};
    }
  const std::size_t self = nodes_.size();
  nodes_.push_back({low, high, first, last, 0, last - first <= kLeaf});
  if (!nodes_[self].leaf) {
    const bool wide = high.x - low.x >= high.y - low.y;
    const auto midpoint_of = [wide](const Feature& f) {
      return wide ? f.from.at.x / 2 + f.to.at.x / 2 : f.from.at.y / 2 + f.to.at.y / 2;
    };
    const std::uint32_t midpoint = first + (last - first) / 2;
    std::nth_element(features_.begin() + first, features_.begin() + midpoint, features_.begin() + last,
                     [&](const Feature& a, const Feature& b) { return midpoint_of(a) < midpoint_of(b); });
    add_node(first, midpoint);
    add_node(midpoint, last);
  }
  nodes_[self].after = static_cast<std::uint32_t>(nodes_.size());
}

// Boxes are those of nearest doubles. Rounding is monotone, so a point of a feature has its nearest doubles in the box.
bool FeatureTree::holds(const NearSpot& z) const {
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool near = node.low.x <= z.at.x && z.at.x <= node.high.x && node.low.y <= z.at.y && z.at.y <= node.high.y;
    for (std::uint32_t k = node.first; near && node.leaf && k < node.last; ++k)
      if (on_segment(features_[k].from, features_[k].to, z)) return true;
    n = near ? n + 1 : node.after;
  }
  return false;
}

}  // namespace dymsum::planar
