// Small meshes that the tests of the room share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial_test {

inline MeshData tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline MeshData cube(double size = 1, Point3 at = {}) {
  MeshData data;
  for (const double z : {at.z, at.z + size}) {
    for (const double y : {at.y, at.y + size}) {
      for (const double x : {at.x, at.x + size}) data.vertices.push_back({x, y, z});
    }
  }
  data.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return data;
}

/// Both meshes' vertices and faces in one.
inline MeshData joined(MeshData a, const MeshData& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += shift;
    a.faces.push_back(std::move(face));
  }
  return a;
}

/// A right prism of this height over a counter-clockwise ring in the plane z = 0.
inline MeshData prism(const std::vector<Point3>& ring, double height) {
  MeshData data;
  const auto n = static_cast<std::uint32_t>(ring.size());
  Face bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    data.vertices.push_back({ring[i].x, ring[i].y, 0});
    data.vertices.push_back({ring[i].x, ring[i].y, height});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
    const std::uint32_t j = (i + 1) % n;
    data.faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  data.faces.push_back(bottom);
  data.faces.push_back(top);
  return data;
}

/// An L of area 3 between 0 and 2.
inline MeshData l_prism() { return prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 1); }

/// A square ring of outer size 3 and inner size 1, height 1: a torus of 16 quadrangles.
inline MeshData square_ring() {
  MeshData data;
  for (const double z : {0.0, 1.0}) {
    for (const double r : {1.5, 0.5}) {
      for (const auto& [x, y] : {std::pair{-r, -r}, {r, -r}, {r, r}, {-r, r}}) data.vertices.push_back({x, y, z});
    }
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    data.faces.push_back({i, j, 8 + j, 8 + i});            // outside
    data.faces.push_back({4 + j, 4 + i, 12 + i, 12 + j});  // inside
    data.faces.push_back({j, i, 4 + i, 4 + j});            // bottom
    data.faces.push_back({8 + i, 8 + j, 12 + j, 12 + i});  // top
  }
  return data;
}

inline MeshData turned_inside_out(MeshData data) {
  for (Face& face : data.faces) std::reverse(face.begin() + 1, face.end());
  return data;
}

/// The same solid with its vertices, faces and the faces' first vertices in another order.
inline MeshData shuffled(const MeshData& data, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint32_t> position(data.vertices.size());
  for (std::uint32_t v = 0; v < position.size(); ++v) position[v] = v;
  std::shuffle(position.begin(), position.end(), random);
  MeshData result;
  result.vertices.resize(position.size());
  for (std::size_t v = 0; v < position.size(); ++v) result.vertices[position[v]] = data.vertices[v];
  for (Face face : data.faces) {
    for (std::uint32_t& v : face) v = position[v];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % face.size()), face.end());
    result.faces.push_back(std::move(face));
  }
  std::shuffle(result.faces.begin(), result.faces.end(), random);
  return result;
}

}  // namespace dymsum::spatial_test
