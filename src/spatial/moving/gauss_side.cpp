#include "spatial/moving/gauss_side.h"

#include <algorithm>
#include <cmath>

#include "spatial/mesh/rounded_vector.h"

namespace dymsum::spatial {

namespace {

/// A vector of size about one, whatever the size of the integers. The relative errors of components below 2^-51.
template <class T>
Vec3 scaled_doubles(const exact::Vector3<T>& v) {
  if constexpr (std::is_same_v<T, exact::Big>) {
    const int drop = bit_length(v);
    return {rounded(v.x, -drop), rounded(v.y, -drop), rounded(v.z, -drop)};
  } else {
    const Vec3 d{to_double(v.x), to_double(v.y), to_double(v.z)};
    return std::ldexp(1.0, -std::ilogb(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}))) * d;
  }
}

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

/// Scales are between 2^-64 and 2^64.
Vec3 times(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

GaussArc arc_between(Vec3 a, Vec3 b) {
  const Vec3 sum = a + b;
  if (length(sum) < 0x1p-10) return {{0, 0, 0}, 1 + 0x1p-40};
  const Vec3 centre = unit(sum);
  return {centre, std::max(length(a - centre), length(b - centre)) + 0x1p-40};
}

}  // namespace

GaussSide::GaussSide(const SolidOperand& operand, const GridPositions& positions) : solid(operand) {
  with_coordinates(positions, [&]<class C>(C) {
    const auto direction = [&](std::uint32_t from, std::uint32_t to) {
      return positions.position<C>(to) - positions.position<C>(from);
    };
    for (const Triangle& t : solid.triangles)
      own_normals_.push_back(scaled_doubles(exact::cross(direction(t[0], t[1]), direction(t[0], t[2]))));
    convex_of.assign(solid.wedges.size(), kNone);
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != Wedge::Bend::convex) continue;
      convex_of[w] = static_cast<std::uint32_t>(convex.size());
      convex.push_back(w);
      own_edges_.push_back(scaled_doubles(direction(solid.wedges[w].from, solid.wedges[w].to)));
    }
    own_rays_.resize(solid.rays.size());
    for (const SupportCone& cone : solid.cones)
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        own_rays_[k] = scaled_doubles(direction(cone.vertex, solid.rays[k]));
  });
  scale({1, 1, 1});
}

void GaussSide::scale(Vec3 factors) {
  const Vec3 of_normals{factors.y * factors.z, factors.x * factors.z, factors.x * factors.y};
  const auto scaled = [](const std::vector<Vec3>& from, Vec3 by, std::vector<Vec3>& to) {
    to.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) to[k] = unit(times(by, from[k]));
  };
  scaled(own_normals_, of_normals, normals);
  scaled(own_edges_, factors, edges);
  scaled(own_rays_, factors, rays);
  set_arcs();
}

void GaussSide::set_arcs() {
  arcs.resize(convex.size());
  for (std::uint32_t e = 0; e < convex.size(); ++e)
    arcs[e] = arc_between(normals[wedge(e).left], normals[wedge(e).right]);
}

}  // namespace dymsum::spatial
