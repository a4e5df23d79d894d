// Random solids at small integers, with many parallel faces, and some that touch themselves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::random_solids {

/// Rings of vertices at small integers between two poles, star-shaped or nearly so; not always valid.
inline MeshData tiny_polyhedron(std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  const int rings = 1 + below(3), around = 3 + below(3);
  const int size = 2 + below(3);
  MeshData m;
  const auto position = [&](double z, double r, double angle) {
    const double s = size * (0.4 + 0.2 * below(4));
    m.vertices.push_back(
        {std::nearbyint(s * r * std::cos(angle)), std::nearbyint(s * r * std::sin(angle)), std::nearbyint(s * z)});
  };
  position(-1, 0, 0);
  for (int j = 1; j <= rings; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = std::numbers::pi * j / (rings + 1);
      position(-std::cos(a), std::sin(a), 2 * std::numbers::pi * i / around);
    }
  position(1, 0, 0);
  const auto top = static_cast<std::uint32_t>(m.vertices.size() - 1);
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(1 + j * around + i % around); };
  for (int i = 0; i < around; ++i) {
    m.faces.push_back({0, id(i + 1, 0), id(i, 0)});
    m.faces.push_back({top, id(i, rings - 1), id(i + 1, rings - 1)});
    for (int j = 0; j + 1 < rings; ++j) {
      m.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return m;
}

inline Mesh valid_polyhedron(std::mt19937_64& random) {
  while (true)
    if (Result<Mesh> mesh = Mesh::create(tiny_polyhedron(random)); mesh.ok()) return *std::move(mesh);
}

using Tetrahedron = std::array<Point3, 4>;  // positively oriented

inline Point3 minus(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double det(Point3 a, Point3 b, Point3 c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}
inline double six_volume(const Tetrahedron& t) { return det(minus(t[1], t[0]), minus(t[2], t[0]), minus(t[3], t[0])); }

/// Some of the tetrahedra of cubes cut along their diagonals, vertices moved a little; none turned over.
inline std::vector<Tetrahedron> random_complex(std::mt19937_64& random, int cubes, int scale) {
  std::map<std::array<int, 3>, Point3> at;
  for (int x = 0; x <= cubes; ++x)
    for (int y = 0; y <= cubes; ++y)
      for (int z = 0; z <= cubes; ++z) {
        const auto moved = [&](int c) { return static_cast<double>(scale * c + static_cast<int>(random() % 2)); };
        at[{x, y, z}] = {moved(x), moved(y), moved(z)};
      }
  std::vector<Tetrahedron> chosen;
  for (int x = 0; x < cubes; ++x)
    for (int y = 0; y < cubes; ++y)
      for (int z = 0; z < cubes; ++z)
        for (std::array<std::size_t, 3> order :
             {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
          std::array<int, 3> corner{x, y, z};
          Tetrahedron t{at[corner]};
          for (std::size_t k = 0; k < 3; ++k) {
            ++corner[order[k]];
            t[k + 1] = at[corner];
          }
          if (six_volume(t) < 0) std::swap(t[0], t[1]);
          const bool turned_over = scale < 3 && six_volume(t) == 0;
          if (random() % 3 != 0 && !turned_over) chosen.push_back(t);
        }
  return chosen;
}

/// The triangles of one tetrahedron only.
inline MeshData boundary(const std::vector<Tetrahedron>& complex) {
  MeshData mesh;
  std::map<std::array<double, 3>, std::uint32_t> index;
  const auto vertex = [&](const Point3& p) {
    const auto [position, added] =
        index.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(p);
    return position->second;
  };
  std::map<std::array<std::uint32_t, 3>, std::pair<Face, int>> triangles;
  for (const Tetrahedron& t : complex)
    for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
      const Face face{vertex(t[i]), vertex(t[j]), vertex(t[k])};
      std::array<std::uint32_t, 3> sorted{face[0], face[1], face[2]};
      std::sort(sorted.begin(), sorted.end());
      auto& [first, count] = triangles[sorted];
      first = face, ++count;
    }
  for (const auto& [sorted, triangle] : triangles)
    if (triangle.second == 1) mesh.faces.push_back(triangle.first);
  return mesh;
}

}  // namespace dymsum::random_solids
