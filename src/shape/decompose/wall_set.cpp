#include "shape/decompose/wall_set.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dymsum::shape {

WallTree::WallTree(const std::vector<Wall>& walls, std::vector<std::uint32_t> of) : of_(std::move(of)) {
  build(walls, 0, std::uint32_t(of_.size()));
}

void WallTree::build(const std::vector<Wall>& walls, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  Box box = walls[of_[first]].box;
  for (std::uint32_t k = first + 1; k < last; ++k) box.add(walls[of_[k]].box);
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, first, last, 0});
  if (last - first <= kLeaf) return;
  const bool wide = box.x1 / 2 - box.x0 / 2 >= box.y1 / 2 - box.y0 / 2;
  const auto midpoint_of = [&](std::uint32_t w) {
    const Box& b = walls[w].box;
    return wide ? b.x0 / 2 + b.x1 / 2 : b.y0 / 2 + b.y1 / 2;
  };
  const std::uint32_t midpoint = first + (last - first) / 2;
  std::nth_element(of_.begin() + first, of_.begin() + midpoint, of_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const auto x = midpoint_of(a), y = midpoint_of(b);
                     return x != y ? x < y : a < b;
                   });
  build(walls, first, midpoint);
  nodes_[self].right = std::uint32_t(nodes_.size());
  build(walls, midpoint, last);
}

WallSet::WallSet(std::vector<Wall> edges) : walls_(std::move(edges)), loose_(std::uint32_t(walls_.size())) {
  std::vector<std::uint32_t> all(walls_.size());
  std::iota(all.begin(), all.end(), 0u);
  trees_.emplace_back(walls_, std::move(all));
}

void WallSet::add(Wall cut) {
  constexpr std::size_t kLoose = 16;
  walls_.push_back(std::move(cut));
  if (walls_.size() - loose_ < kLoose) return;
  std::vector<std::uint32_t> of(walls_.size() - loose_);
  std::iota(of.begin(), of.end(), loose_);
  loose_ = std::uint32_t(walls_.size());
  while (trees_.size() > 1 && trees_.back().of().size() <= of.size()) {
    of.insert(of.end(), trees_.back().of().begin(), trees_.back().of().end());
    trees_.pop_back();
  }
  trees_.emplace_back(walls_, std::move(of));
}

}  // namespace dymsum::shape
