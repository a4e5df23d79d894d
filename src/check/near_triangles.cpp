#include "check/near_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dymsum::check {
namespace {

using spatial::Box;
using spatial::BoxTree;

Vec3 vector_of(const Point3& p) { return {p.x, p.y, p.z}; }

/// The nearest position of the segment, at 0 or 1 of its ends.
std::pair<Vec3, double> on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double n = dot(d, d), t = n > 0 ? std::clamp(dot(p - a, d) / n, 0.0, 1.0) : 0;
  return {t == 1 ? b : a + t * d, t};
}

/// Calls see(item) for the items of leaves, nearest boxes first, while boxes are no further than limit().
template <class Limit, class See>
void visit_near(const BoxTree& tree, const Vec3& p, Limit limit, See see) {
  std::vector<std::pair<double, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [d, k] = stack.back();
    stack.pop_back();
    if (d > limit()) continue;
    const BoxTree::Node& node = tree.node(k);
    if (node.leaf()) {
      for (std::uint32_t i = node.first; i < node.last; ++i)
        if (distance(tree.box(tree.item(i)), p) <= limit()) see(tree.item(i));
      continue;
    }
    std::pair left(distance(tree.node(node.left).box, p), node.left);
    std::pair right(distance(tree.node(node.right).box, p), node.right);
    if (left.first < right.first) std::swap(left, right);
    stack.push_back(left);
    stack.push_back(right);
  }
}

}  // namespace

NearTriangles::NearTriangles(const spatial::ExactSet& set, double reach) : set_(set), reach_(reach) {
  std::vector<Box> boxes;
  for (const Face& f : set.set.faces) {
    Box& box = boxes.emplace_back();
    for (const std::uint32_t v : f) {
      const Vec3 p = vector_of(set.set.vertices[v]);
      box.add(p);
      reach_ = std::max({reach_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  tree_ = BoxTree(std::move(boxes));
  // Corners and positions are rounded, a position of the triangle is a corner and two multiples of edges, at most as
  // large as these: no more than some ten roundings of three coordinates up to twice the reach.
  slack_ = 0x1p-46 * reach_ + 0x1p-1060;
}

ExactTriangle NearTriangles::exact(std::uint32_t triangle) const {
  const Face& f = set_.set.faces[triangle];
  return {set_.at[f[0]], set_.at[f[1]], set_.at[f[2]]};
}

NearOnTriangle NearTriangles::near(const Vec3& p, std::uint32_t triangle) const {
  const Face& f = set_.set.faces[triangle];
  const Vec3 t[3]{vector_of(set_.set.vertices[f[0]]), vector_of(set_.set.vertices[f[1]]),
                  vector_of(set_.set.vertices[f[2]])};
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  // Where a triangle is thin the parameters of the foot err by much: what is left of the way to it is divided again.
  constexpr int kRefinements = 3;
  double a = 0, b = 0;
  Vec3 rest = p - t[0];
  for (int k = 0; k < kRefinements; ++k) {
    a += dot(cross(rest, v), n) / dot(n, n), b += dot(cross(u, rest), n) / dot(n, n);
    rest = p - (t[0] + a * u + b * v);
  }
  NearOnTriangle best;
  double least = std::numeric_limits<double>::infinity();
  if (a >= 0 && b >= 0 && a + b <= 1) {
    best.at = t[0] + a * u + b * v;
    least = length(p - best.at);
  }
  for (int k = 0; k < 3; ++k) {
    const auto [at, along] = on_segment(p, t[k], t[(k + 1) % 3]);
    const double d = length(p - at);
    if (d >= least) continue;
    least = d;
    best = {at, along == 0 ? k : along == 1 ? (k + 1) % 3 : 3 + k};
  }
  return best;
}

double NearTriangles::distance_above(const Vec3& p, std::uint32_t triangle) const {
  return length(p - near(p, triangle).at) * (1 + 0x1p-49) + slack_;
}

std::uint32_t NearTriangles::rough_nearest(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = tree_.item(0);
  visit_near(
      tree_, p, [&] { return least; },
      [&](std::uint32_t t) {
        const double d = distance_above(p, t);
        if (d < least || (d == least && t < nearest)) least = d, nearest = t;
      });
  return nearest;
}

NearTriangles::Nearest NearTriangles::nearest(const RationalVector& exact, const Vec3& p) const {
  const double slack = kRoughDistance * reach_;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> near;
  const auto rough = [&](std::uint32_t t) {
    const Face& f = set_.set.faces[t];
    const auto& at = set_.set.vertices;
    const double d = rough_distance({p.x, p.y, p.z}, {at[f[0]], at[f[1]], at[f[2]]});
    near.emplace_back(d, t);
    least = std::min(least, d);
  };
  visit_near(
      tree_, p, [&] { return least + slack; }, rough);
  std::optional<Nearest> best;
  for (const auto& [d, t] : near) {
    if (d > least + slack) continue;
    TriangleNearest next = nearest_on(exact, this->exact(t));
    if (!best || exact::compare(next.squared, best->squared) < 0)
      best = Nearest{std::move(next.squared), std::move(next.at), t};
  }
  return *std::move(best);
}

}  // namespace dymsum::check
