// Expected sizes of a reduced convolution, from angles of either operand by itself.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "spatial/convolution/predicted_cost.h"
#include "spatial/convolution/sampled_pairs.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

namespace {

Vec3 between(const SolidOperand& solid, std::uint32_t from, std::uint32_t to) {
  const Point3 &a = solid.vertices[from], &b = solid.vertices[to];
  return {b.x - a.x, b.y - a.y, b.z - a.z};
}
Vec3 normal(const SolidOperand& solid, std::uint32_t t) {
  const Triangle& v = solid.triangles[t];
  return cross(between(solid, v[0], v[1]), between(solid, v[0], v[2]));
}
double angle(Vec3 u, Vec3 v) { return std::atan2(length(cross(u, v)), dot(u, v)); }

/// The sum, over convex edges, of the lengths of the arcs of their normals.
double convex_angles(const SolidOperand& solid) {
  double sum = 0;
  for (const Wedge& w : solid.wedges) {
    if (w.is_segment()) sum += 2 * std::numbers::pi;
    else if (w.bend == Wedge::Bend::convex) sum += angle(normal(solid, w.left), normal(solid, w.right));
  }
  return sum;
}

/// The normals that a cone supports are a polygon on the sphere whose outer angles are those between the cone's rays:
/// its area is what they lack of a full turn.
double cover(const SolidOperand& solid) {
  double area = 0;
  for (const SupportCone& cone : solid.cones) {
    const std::span<const std::uint32_t> rays = solid.rays_of(cone);
    double turns = 0;
    for (std::size_t k = 0; k < rays.size(); ++k)
      turns += angle(between(solid, cone.vertex, rays[k]), between(solid, cone.vertex, rays[(k + 1) % rays.size()]));
    area += std::max(0.0, 2 * std::numbers::pi - turns);
  }
  return area / (4 * std::numbers::pi);
}

}  // namespace

SpatialCost predicted_cost(const SolidOperand& p, const SolidOperand& q) {
  SpatialCost cost;
  cost.edge_edge = convex_angles(p) * convex_angles(q) / (2 * std::numbers::pi * std::numbers::pi);
  const auto m = static_cast<double>(p.triangles.size()), n = static_cast<double>(q.triangles.size());
  cost.face_vertex = cover(p) * n + cover(q) * m;
  cost.full_face_vertex = p.triangles.size() * q.vertices.size() + q.triangles.size() * p.vertices.size();
  cost.full_edge_edge = p.wedges.size() * q.wedges.size();
  const double facets = cost.edge_edge + cost.face_vertex, more = sampled_pairs(p, q) - kPairsPerFacet * facets;
  cost.bytes = static_cast<std::uint64_t>(kBytesPerFacet * facets + kBytesPerPair * std::max(0.0, more));
  return cost;
}

}  // namespace dymsum::spatial

namespace dymsum {

SpatialCost predict_cost(const Mesh& p, const Mesh& q) {
  return spatial::predicted_cost(spatial::solid_operand(p.data(), p.thin_faces()),
                                 spatial::solid_operand(q.data(), q.thin_faces()));
}

}  // namespace dymsum
