#include "spatial/moving/gauss_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace dymsum::spatial {

namespace {

constexpr int kMostDepth = 7;
constexpr std::size_t kFew = 10;  // listed cones and arcs that need no further split

/// Face 2 k lies towards the axis k, face 2 k + 1 the other way; u and v are the other two coordinates over that one.
Vec3 direction(std::uint32_t face, double u, double v) {
  const double s = face % 2 == 0 ? 1 : -1;
  const Vec3 d = face / 2 == 0 ? Vec3{s, u, v} : face / 2 == 1 ? Vec3{u, s, v} : Vec3{u, v, s};
  return (1 / length(d)) * d;
}

}  // namespace

GaussCells::GaussCells(const GaussSide& side) {
  // A third of what a cone would be wide if all shared the sphere.
  const double share = 4 * std::numbers::pi / static_cast<double>(side.solid.cones.size() + 1);
  reach_ = std::clamp(0.35 * std::sqrt(share), 0.02, 0.3);
  std::vector<std::uint32_t> cones(side.solid.cones.size()), arcs(side.arcs.size());
  std::iota(cones.begin(), cones.end(), 0u), std::iota(arcs.begin(), arcs.end(), 0u);
  nodes_.resize(6);
  for (std::uint32_t face = 0; face < 6; ++face) split(side, face, {face, -1, -1, 2}, cones, arcs, 0);
}

void GaussCells::split(const GaussSide& side, std::uint32_t node, const Square& square,
                       std::span<const std::uint32_t> cones, std::span<const std::uint32_t> arcs, int depth) {
  const Vec3 middle = direction(square.face, square.u + square.size / 2, square.v + square.size / 2);
  double radius = 0;
  for (const double u : {square.u, square.u + square.size})
    for (const double v : {square.v, square.v + square.size})
      radius = std::max(radius, length(direction(square.face, u, v) - middle));
  // Scaling may turn a cone by a quarter of the reach before cells are made again, and rounding may put a direction
  // into the cell beside its own.
  const double around = radius + 0.25 * reach_ + 0x1p-30, far = radius + reach_ + 0x1p-30;
  std::vector<std::uint32_t> near_cones, near_arcs;
  for (const std::uint32_t c : cones) {
    const SupportCone& cone = side.solid.cones[c];
    const auto above = [&](const Vec3& ray) { return dot(middle, ray) > around; };
    if (std::none_of(side.rays.begin() + cone.first, side.rays.begin() + cone.last, above)) near_cones.push_back(c);
  }
  for (const std::uint32_t e : arcs)
    if (std::abs(dot(middle, side.edges[e])) <= far &&
        length(middle - side.arcs[e].middle) - side.arcs[e].radius <= far)
      near_arcs.push_back(e);
  const bool few = near_cones.size() + near_arcs.size() <= kFew;
  if (few || radius < 0.6 * reach_ || depth == kMostDepth) {
    nodes_[node].cones = static_cast<std::uint32_t>(lists_.size());
    lists_.insert(lists_.end(), near_cones.begin(), near_cones.end());
    nodes_[node].arcs = static_cast<std::uint32_t>(lists_.size());
    lists_.insert(lists_.end(), near_arcs.begin(), near_arcs.end());
    nodes_[node].end = static_cast<std::uint32_t>(lists_.size());
    return;
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].children = first;
  nodes_.resize(nodes_.size() + 4);
  const double half = square.size / 2;
  for (std::uint32_t k = 0; k < 4; ++k)
    split(side, first + k, {square.face, square.u + (k & 1 ? half : 0), square.v + (k & 2 ? half : 0), half},
          near_cones, near_arcs, depth + 1);
}

GaussCells::Cell GaussCells::at(Vec3 n) const {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const std::uint32_t axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const double along = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  const double size = std::abs(along);
  double u = (axis == 0 ? n.y : n.x) / size, v = (axis == 2 ? n.y : n.z) / size;
  std::uint32_t node = 2 * axis + (along < 0 ? 1 : 0);
  // The cell's own coordinates: from its middle, in halves of its width.
  while (nodes_[node].children != 0) {
    const std::uint32_t right = u >= 0, up = v >= 0;
    node = nodes_[node].children + right + 2 * up;
    u = 2 * u + (right ? -1 : 1), v = 2 * v + (up ? -1 : 1);
  }
  const Node& leaf = nodes_[node];
  return {{lists_.data() + leaf.cones, lists_.data() + leaf.arcs}, {lists_.data() + leaf.arcs, lists_.data() + leaf.end}};
}

}  // namespace dymsum::spatial
