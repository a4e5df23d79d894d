// Solids that are not convex, and sizes of tight features.
#pragma once

#include <cmath>
#include <utility>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

inline MeshData box(double half) {
  MeshData m = solids::box(-1, -1, -1, 1, 1, 1).data();
  for (Point3& p : m.vertices) p = {half * p.x, half * p.y, half * p.z};
  return m;
}

inline MeshData moved(MeshData m, double dx, double dy, double dz) {
  for (Point3& p : m.vertices) p = {p.x + dx, p.y + dy, p.z + dz};
  return m;
}

/// A cube of size 10 without a corner of 6 x 6 x 10.
inline MeshData ell() {
  MeshData m;
  for (const double z : {0.0, 10.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {4.0, 4.0}, {4.0, 10.0}, {0.0, 10.0}})
      m.vertices.push_back({x, y, z});
  m.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) m.faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  return m;
}

/// A cube of size 10 about the origin with a tunnel of 2 x 2 along x.
inline MeshData tunnel() {
  MeshData m;
  for (const double x : {-5.0, 5.0})
    for (const double h : {5.0, 1.0})
      for (const auto& [y, z] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}}) m.vertices.push_back({x, y, z});
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t j = (k + 1) % 4;
    m.faces.push_back({k, j, j + 8, k + 8});
    m.faces.push_back({4 + k, 12 + k, 12 + j, 4 + j});
    m.faces.push_back({8 + k, 8 + j, 12 + j, 12 + k});
    m.faces.push_back({k, 4 + k, 4 + j, j});
  }
  return m;
}

/// A cube of half size 5 with a cubic cavity of half size 1.
inline MeshData cavity() {
  MeshData m = box(5);
  const MeshData inner = box(1);
  for (const Point3& p : inner.vertices) m.vertices.push_back(p);
  for (Face f : inner.faces) {
    for (std::uint32_t& v : f) v += 8;
    m.faces.push_back({f.rbegin(), f.rend()});
  }
  return m;
}

inline double length(const SpatialSum& s, const std::array<std::uint32_t, 2>& segment) {
  const Point3 &a = s.vertices[segment[0]], &b = s.vertices[segment[1]];
  return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

inline double tight_area(const SpatialSum& s) {
  SpatialSum faces = s;
  faces.faces.clear();
  for (const auto& loops : s.tight_faces) faces.faces.push_back({loops, {}, {}, 0});
  return faces.area();
}

}  // namespace dymsum
