// Random small solids for sums in which one of them turns: saddle vertices, shared corners and parallel faces, at
// integers, in decimals, and turned.
#pragma once

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "dymsum/solid_rotation_events.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::turning_pairs {

struct Pair {
  Mesh p, q;
  TurnAxis axis{};
  MovingOperand moving = MovingOperand::p;
  AxisTurn from, to;
};

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ULL + 1) {}

  /// Its range of angles is a part of a turn: some begin or end where everything is parallel.
  Pair pair() {
    Pair pair{solid(), solid(), {}, {}, {}, {}};
    if (below(8) == 0) pair.q = pair.p;
    if (below(8) == 0) pair.q = reflected(pair.p);
    static constexpr TurnAxis kAxes[] = {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 2, 3}, {2, -1, 2}, {1, 1, 1}};
    pair.axis = kAxes[below(std::size(kAxes))];
    pair.moving = below(2) == 0 ? MovingOperand::p : MovingOperand::q;
    const double quarter = std::numbers::pi / 2, width = 0.05 + 0.01 * below(20);
    const double begin = below(4) == 0 ? quarter * (below(4) - 2) - width / 3 : 0.001 * below(6000) - 3;
    pair.from = AxisTurn::nearest(pair.axis, begin).value(),
    pair.to = AxisTurn::nearest(pair.axis, begin + width).value();
    return pair;
  }

 private:
  int below(std::size_t n) { return static_cast<int>(random_() % n); }
  double small() { return below(9) - 4; }

  Mesh solid() {
    while (true) {
      MeshData mesh = any();
      if (below(4) == 0) in_decimals(mesh);
      if (below(6) == 0) turn(mesh);
      if (Result<Mesh> made = Mesh::create(std::move(mesh)); made.ok() && !made->has_thin_parts())
        return *std::move(made);
    }
  }
  MeshData any() {
    switch (below(6)) {
      case 0:
        return random_solids::tiny_polyhedron(random_);
      case 1:
        return dented(tetrahedron(), 4);
      case 2:
        return dented(tetrahedron(), 2);
      case 3:
        return dented(solids::tessellated_cube(6, 1).data(), 3);
      case 4:
        return cubes();
      default:
        return tetrahedron();
    }
  }

  MeshData tetrahedron() {
    MeshData m;
    for (int k = 0; k < 4; ++k) m.vertices.push_back({small(), small(), small()});
    if (random_solids::six_volume({m.vertices[0], m.vertices[1], m.vertices[2], m.vertices[3]}) < 0)
      std::swap(m.vertices[0], m.vertices[1]);
    m.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return m;
  }
  /// Every `each`th face is split at a point beside its centre; vertices are moved. Most of the new ones, or their
  /// neighbours, are saddles.
  MeshData dented(MeshData m, std::size_t each) {
    std::vector<Face> faces;
    for (const Face& f : m.faces) {
      if (below(each) != 0) {
        faces.push_back(f);
        continue;
      }
      const auto apex = static_cast<std::uint32_t>(m.vertices.size());
      Point3 sum;
      for (const std::uint32_t v : f) sum = {sum.x + m.vertices[v].x, sum.y + m.vertices[v].y, sum.z + m.vertices[v].z};
      const auto near = [&](double c) { return std::nearbyint(c / static_cast<double>(f.size()) + below(3) - 1); };
      m.vertices.push_back({near(sum.x), near(sum.y), near(sum.z)});
      for (std::size_t k = 0; k < f.size(); ++k) faces.push_back({f[k], f[(k + 1) % f.size()], apex});
    }
    m.faces = std::move(faces);
    for (Point3& v : m.vertices)
      if (below(2) == 0) v = {v.x + below(3) - 1, v.y + below(3) - 1, v.z + below(3) - 1};
    return m;
  }
  /// A few cubes of a lattice, which share faces, edges or corners.
  MeshData cubes() {
    std::array<bool, 8> full{};
    for (int k = 2 + below(4); k > 0; --k) full[below(8)] = true;
    MeshData m;
    const auto filled = [&](int x, int y, int z) {
      return x >= 0 && y >= 0 && z >= 0 && x < 2 && y < 2 && z < 2 && full[x + 2 * y + 4 * z];
    };
    for (int z = 0; z < 3; ++z)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) m.vertices.push_back({2.0 * x - 1, 2.0 * y - 2, 2.0 * z - 3});
    for (int c = 0; c < 8; ++c)
      if (full[c])
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> at{c & 1, c >> 1 & 1, c >> 2}, beside = at;
            beside[axis] += side == 0 ? -1 : 1;
            if (!filled(beside[0], beside[1], beside[2])) m.faces.push_back(square(at, axis, side));
          }
    return without_lone_vertices(m);
  }
  static Face square(std::array<int, 3> at, int axis, int side) {
    at[axis] += side;
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    Face face;
    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      std::array<int, 3> corner = at;
      corner[u] += a, corner[w] += b;
      face.push_back(static_cast<std::uint32_t>(corner[0] + 3 * corner[1] + 9 * corner[2]));
    }
    return side == 1 ? face : Face{face.rbegin(), face.rend()};
  }
  static MeshData without_lone_vertices(const MeshData& all) {
    MeshData m;
    std::map<std::uint32_t, std::uint32_t> name;
    for (const Face& f : all.faces) {
      Face renamed;
      for (const std::uint32_t v : f) {
        const auto [at, fresh] = name.try_emplace(v, static_cast<std::uint32_t>(m.vertices.size()));
        if (fresh) m.vertices.push_back(all.vertices[v]);
        renamed.push_back(at->second);
      }
      m.faces.push_back(std::move(renamed));
    }
    return m;
  }

  /// Triangles alone: quadrangles would not stay flat.
  static void triangulate(MeshData& m) {
    std::vector<Face> faces;
    for (const Face& f : m.faces)
      for (std::size_t k = 1; k + 1 < f.size(); ++k) faces.push_back({f[0], f[k], f[k + 1]});
    m.faces = std::move(faces);
  }
  void in_decimals(MeshData& m) {
    triangulate(m);
    for (Point3& v : m.vertices) v = {v.x / 10, (v.y * 10 + below(3)) / 100, v.z / 10};
  }
  void turn(MeshData& m) {
    triangulate(m);
    const double c = std::cos(0.5236), s = std::sin(0.5236);
    for (Point3& v : m.vertices) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    if (below(2) == 0)
      for (Point3& v : m.vertices) v = {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
  }
  static Mesh reflected(const Mesh& mesh) {
    MeshData data = mesh.data();
    for (Point3& v : data.vertices) v = {-v.x, -v.y, -v.z};
    for (Face& f : data.faces) f = {f.rbegin(), f.rend()};
    return Mesh::create(std::move(data)).value();
  }

  std::mt19937_64 random_;
};

}  // namespace dymsum::turning_pairs
