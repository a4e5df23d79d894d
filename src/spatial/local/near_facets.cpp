#include "spatial/local/near_facets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "spatial/convolution/reduced_facets.h"

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

namespace {

Sphere sphere_of(std::span<const Vec3> corners, double each) {
  Vec3 low = corners[0], high = low;
  for (const Vec3& v : corners) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  Sphere s{0.5 * (low + high), 0};
  for (const Vec3& v : corners) s.radius = std::max(s.radius, length(v - s.centre));
  s.radius = s.radius * (1 + 0x1p-40) + 4 * each + (length(low) + length(high)) * 0x1p-48;
  return s;
}

bool reaches(const Sphere& a, const Sphere& b, const Box& box) {
  const Vec3 m = a.centre + b.centre;
  const auto beyond = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  const Vec3 gap{beyond(box.low.x, box.high.x, m.x), beyond(box.low.y, box.high.y, m.y),
                 beyond(box.low.z, box.high.z, m.z)};
  const double radius = (a.radius + b.radius) * (1 + 0x1p-40);
  return dot(gap, gap) <= radius * radius * (1 + 0x1p-40);
}

/// Calls f(i, j) for the items of all leaves whose spheres' sum reaches the box.
template <class F>
void for_each_pair(const SphereTree& a, const SphereTree& b, const Box& box, F f) {
  if (a.empty() || b.empty()) return;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const SphereTree::Node &u = a.node(i), &v = b.node(j);
    if (!reaches(u.sphere, v.sphere, box)) continue;
    if (u.leaf() && v.leaf()) {
      f(u.item, v.item);
    } else if (v.leaf() || (!u.leaf() && u.sphere.radius >= v.sphere.radius)) {
      stack.push_back({u.left, j}), stack.push_back({u.right, j});
    } else {
      stack.push_back({i, v.left}), stack.push_back({i, v.right});
    }
  }
}

/// Normals, edges and rays of one operand where it stands.
struct PosedSide {
  DirectionSource::Of of;
  const SolidOperand& solid;
  std::vector<Direction> normals, edges, rays;  // of triangles, wedges, and as solid.rays

  PosedSide(DirectionSource::Of which, const SolidOperand& operand, const std::vector<Vec3>& at, double each)
      : of(which), solid(operand), rays(operand.rays.size()) {
    for (const Triangle& t : solid.triangles) normals.push_back(normal_direction(at[t[0]], at[t[1]], at[t[2]], each));
    for (const Wedge& w : solid.wedges) edges.push_back(edge_direction(at[w.from], at[w.to], each));
    for (const SupportCone& cone : solid.cones)
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        rays[k] = edge_direction(at[cone.vertex], at[solid.rays[k]], each);
  }
};

/// The rule of facets, by doubles where they decide.
class FilteredRule {
 public:
  FilteredRule(const SumSpace& space, const PosedSide& p, const PosedSide& q) : space_(space), p_(p), q_(q) {}

  bool holds(const PosedSide& faces, std::uint32_t t, const PosedSide& vertices, const SupportCone& cone) const {
    bool proved = true;
    for (std::uint32_t k = cone.first; k < cone.last; ++k) {
      const int s = filtered_sign(faces.normals[t], vertices.rays[k]);
      if (s > 0) return false;
      proved = proved && s < 0;
    }
    return proved || makes_facet(space_, faces.of, faces.solid, t, vertices.solid, cone);
  }

  /// The side of the facet that convex wedges make; 0 for none.
  int side(std::uint32_t e, std::uint32_t g) const {
    const Wedge &a = p_.solid.wedges[e], &b = q_.solid.wedges[g];
    const EdgePairSigns at{
        filtered_sign(p_.normals[a.left], q_.edges[g]), filtered_sign(p_.normals[a.right], q_.edges[g]),
        filtered_sign(q_.normals[b.left], p_.edges[e]), filtered_sign(q_.normals[b.right], p_.edges[e])};
    if (at.e_left * at.e_right > 0 || at.g_left * at.g_right > 0) return 0;
    return at.any_zero() ? facet_side(space_, p_.solid, q_.solid, e, g) : edge_pair_side(at);
  }

 private:
  const SumSpace& space_;
  const PosedSide &p_, &q_;
};

}  // namespace

NearFacets::Side::Side(const SolidOperand& operand) : solid(operand) {
  for (std::uint32_t w = 0; w < solid.wedges.size(); ++w)
    if (solid.wedges[w].bend == Wedge::Bend::convex) convex.push_back(w);
}

void NearFacets::Side::fit(const std::vector<Vec3>& at, double each) {
  std::vector<Sphere> of_faces, of_cones, of_edges;
  for (const Triangle& t : solid.triangles)
    of_faces.push_back(sphere_of(std::array{at[t[0]], at[t[1]], at[t[2]]}, each));
  for (const SupportCone& cone : solid.cones) of_cones.push_back(sphere_of(std::array{at[cone.vertex]}, each));
  for (const std::uint32_t w : convex)
    of_edges.push_back(sphere_of(std::array{at[solid.wedges[w].from], at[solid.wedges[w].to]}, each));
  const auto put = [](SphereTree& tree, const std::vector<Sphere>& spheres) {
    if (tree.empty()) tree = SphereTree(spheres);
    else tree.fit(spheres);
  };
  put(faces, of_faces), put(cones, of_cones), put(edges, of_edges);
}

NearFacets::NearFacets(const SolidPair& pair) : pair_(pair), sides_{Side(pair.p), Side(pair.q)} {}

ReducedConvolution NearFacets::find(const SumSpace& space, const Box& box) {
  const double each = space.sum_radius();
  sides_[0].fit(space.p(), each), sides_[1].fit(space.q(), each);
  const PosedSide p(DirectionSource::Of::p, pair_.p, space.p(), each),
      q(DirectionSource::Of::q, pair_.q, space.q(), each);
  const FilteredRule rule(space, p, q);
  ReducedConvolution near;
  pairs_ = 0;
  for_each_pair(sides_[0].faces, sides_[1].cones, box, [&](std::uint32_t t, std::uint32_t c) {
    ++pairs_;
    if (rule.holds(p, t, q, pair_.q.cones[c]))
      near.facets.push_back(face_vertex_facet(DirectionSource::Of::p, pair_.p, t, pair_.q.cones[c].vertex));
  });
  for_each_pair(sides_[0].cones, sides_[1].faces, box, [&](std::uint32_t c, std::uint32_t t) {
    ++pairs_;
    if (rule.holds(q, t, p, pair_.p.cones[c]))
      near.facets.push_back(face_vertex_facet(DirectionSource::Of::q, pair_.q, t, pair_.p.cones[c].vertex));
  });
  near.counts.face_vertex = near.facets.size();
  for_each_pair(sides_[0].edges, sides_[1].edges, box, [&](std::uint32_t i, std::uint32_t j) {
    ++pairs_;
    const std::uint32_t e = sides_[0].convex[i], g = sides_[1].convex[j];
    if (const int side = rule.side(e, g); side != 0)
      near.facets.push_back(edge_edge_facet(pair_.p, pair_.q, e, g, side));
  });
  near.counts.edge_edge = near.facets.size() - near.counts.face_vertex;
  near.counts.pairs_tried = pairs_;
  std::sort(near.facets.begin(), near.facets.end(), [](const SumFacet& a, const SumFacet& b) {
    return std::tie(a.kind, a.p, a.q, a.corner) < std::tie(b.kind, b.p, b.q, b.corner);
  });
  for (const SumFacet& f : near.facets) near.planes.push_back(plane_of(f));
  return near;
}

}  // namespace dymsum::spatial
