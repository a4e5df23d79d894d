#include "spatial/local/sphere_tree.h"

#include <algorithm>
#include <numeric>

namespace dymsum::spatial {

namespace {

double along(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A sphere around two others, a little larger than the smallest one.
Sphere around(const Sphere& a, const Sphere& b) {
  const Vec3 direction = b.centre - a.centre;
  const double gap = length(direction);
  if (gap + b.radius <= a.radius) return a;
  if (gap + a.radius <= b.radius) return b;
  const double radius = 0.5 * (gap + a.radius + b.radius);
  return {a.centre + ((radius - a.radius) / gap) * direction, radius * (1 + 0x1p-40)};
}

}  // namespace

SphereTree::SphereTree(const std::vector<Sphere>& spheres) : order_(spheres.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * spheres.size());
  if (!spheres.empty()) build(spheres, 0, static_cast<std::uint32_t>(spheres.size()));
  fit(spheres);
}

std::uint32_t SphereTree::build(const std::vector<Sphere>& spheres, std::uint32_t first, std::uint32_t last) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (last - first == 1) {
    nodes_[id].item = order_[first];
    return id;
  }
  Vec3 low = spheres[order_[first]].centre, high = low;
  for (std::uint32_t k = first; k < last; ++k) {
    const Vec3 m = spheres[order_[k]].centre;
    low = {std::min(low.x, m.x), std::min(low.y, m.y), std::min(low.z, m.z)};
    high = {std::max(high.x, m.x), std::max(high.y, m.y), std::max(high.z, m.z)};
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double u = along(spheres[a].centre, axis), v = along(spheres[b].centre, axis);
                     return u != v ? u < v : a < b;
                   });
  const std::uint32_t left = build(spheres, first, half), right = build(spheres, half, last);
  nodes_[id].left = left, nodes_[id].right = right;
  return id;
}

void SphereTree::fit(const std::vector<Sphere>& spheres) {
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
    node->sphere = node->leaf() ? spheres[node->item] : around(nodes_[node->left].sphere, nodes_[node->right].sphere);
}

}  // namespace dymsum::spatial
