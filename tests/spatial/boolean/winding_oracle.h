// Winding numbers by rational arithmetic: triangles that a ray in a general direction crosses, one after the other.
#pragma once

#include <optional>

#include "dymsum/mesh.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::oracles {

using RationalVector = std::array<Rational, 3>;

inline Rational exact_of(double v) { return Rational::of(v).value(); }
inline RationalVector exact_of(const Point3& p) { return {exact_of(p.x), exact_of(p.y), exact_of(p.z)}; }
inline RationalVector vector_of(const RationalPoint3& p) { return {p.x, p.y, p.z}; }

inline RationalVector operator-(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Rational determinant(const RationalVector& a, const RationalVector& b, const RationalVector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A closed surface of triangles.
struct ExactSurface {
  std::vector<RationalVector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Of faces that are fanned, whatever their shape: as sets of signed triangles that is right.
inline ExactSurface exact_surface(const MeshData& mesh) {
  ExactSurface surface;
  for (const Point3& p : mesh.vertices) surface.vertices.push_back(exact_of(p));
  for (const Face& f : mesh.faces)
    for (std::size_t k = 2; k < f.size(); ++k) surface.triangles.push_back({f[0], f[k - 1], f[k]});
  return surface;
}
inline ExactSurface exact_surface(const SpatialSum& sum) {
  ExactSurface surface;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) surface.vertices.push_back(vector_of(sum.exact(v)));
  for (const SpatialFace& face : sum.faces)
    for (const auto& loop : face.loops)
      for (std::size_t k = 2; k < loop.size(); ++k) surface.triangles.push_back({loop[0], loop[k - 1], loop[k]});
  return surface;
}

/// How often the surface goes around a position. Nothing where the position is on a triangle, or the ray from it passes
/// an edge.
inline std::optional<int> winding_at(const ExactSurface& surface, const RationalVector& at) {
  const RationalVector ray{Rational::of(1009, 1013).value(), Rational::of(10007, 19997).value(),
                           Rational::of(7919, 20011).value()};
  int winding = 0;
  for (const auto& [i, j, k] : surface.triangles) {
    const RationalVector a = surface.vertices[i] - at, b = surface.vertices[j] - at, c = surface.vertices[k] - at;
    const int s[3] = {determinant(ray, a, b).sign(), determinant(ray, b, c).sign(), determinant(ray, c, a).sign()};
    const int height = determinant(a, b, c).sign();
    const bool around = s[0] == s[1] && s[1] == s[2];
    if (s[0] * s[1] * s[2] == 0) {
      // A triangle on a line, or seen from its edge, is not crossed; nothing else may be special.
      const auto [p, q] = std::pair{b - a, c - a};
      if (determinant(p, q, ray).sign() != 0 && s[0] * s[1] >= 0 && s[1] * s[2] >= 0 && s[2] * s[0] >= 0)
        return std::nullopt;
      continue;
    }
    if (!around) continue;
    if (height == 0) return std::nullopt;
    // det(a, b, c) = 6 times the volume seen from the position: positive where the triangle's front looks away.
    if (height * s[0] > 0) winding += s[0];
  }
  return winding;
}

}  // namespace dymsum::oracles
