// Solids and moves for sums in motion.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/solids.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::moving_cases {

/// 2 nu nv triangles about the z axis.
inline MeshData torus(double large, double small, int nu, int nv) {
  MeshData mesh;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * std::numbers::pi * i / nu, w = 2 * std::numbers::pi * j / nv,
                   r = large + small * std::cos(w);
      const auto on_grid = [](double c) { return std::ldexp(std::nearbyint(std::ldexp(c, 16)), -16); };
      mesh.vertices.push_back({on_grid(r * std::cos(u)), on_grid(r * std::sin(u)), on_grid(small * std::sin(w))});
    }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>((i % nu) * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      mesh.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return mesh;
}

/// A sphere with dents: 20 frequency^2 triangles, many of their edges reflex.
inline MeshData bumpy(int frequency, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MeshData mesh = solids::geodesic_sphere(frequency, 1, solids::kDemoSnap).data();
  for (Point3& v : mesh.vertices) {
    const double by = 4 + static_cast<double>(random() % 256) / 128;
    const auto on_grid = [&](double c) { return std::ldexp(std::nearbyint(std::ldexp(by * c, 12)), -12); };
    v = {on_grid(v.x), on_grid(v.y), on_grid(v.z)};
  }
  return mesh;
}

/// A wheel with teeth about the z axis.
inline Mesh gear(int teeth, double radius, double height) {
  Ring ring;
  for (int k = 0; k < 4 * teeth; ++k) {
    const double r = k % 4 < 2 ? radius : radius - 1, a = 2 * std::numbers::pi * k / (4 * teeth);
    const auto on_grid = [](double c) { return std::ldexp(std::nearbyint(std::ldexp(c, 10)), -10); };
    ring.push_back({on_grid(r * std::cos(a)), on_grid(r * std::sin(a))});
  }
  return solids::prism(ring, height);
}

inline Mesh mesh_of(const MeshData& data) { return Mesh::create(data).value(); }
inline Mesh reflected(const Mesh& mesh) {
  MeshData data = mesh.data();
  for (Point3& v : data.vertices) v = {-v.x, -v.y, -v.z};
  for (Face& f : data.faces) f = {f.rbegin(), f.rend()};
  return mesh_of(data);
}

struct NamedPair {
  std::string name;
  Mesh p, q;
};
inline std::vector<NamedPair> small_pairs() {
  std::mt19937_64 random(5);
  const Mesh ell_mesh = mesh_of(ell()), tunnel_mesh = mesh_of(tunnel()), cube = mesh_of(box(1)),
             ring = mesh_of(torus(3, 1, 6, 4)), star = random_solids::valid_polyhedron(random);
  return {{"cubes", cube, cube},
          {"L + cube", ell_mesh, cube},
          {"L with itself", ell_mesh, ell_mesh},
          {"L with its reflection", ell_mesh, reflected(ell_mesh)},
          {"tunnel + L", tunnel_mesh, ell_mesh},
          {"cavity + cube", mesh_of(cavity()), cube},
          {"tori", ring, mesh_of(torus(2, 0.75, 5, 5))},
          {"torus with itself", ring, ring},
          {"gears in mesh", gear(5, 4, 2), gear(4, 3, 2)},
          {"bumpy balls", mesh_of(bumpy(2, 1)), mesh_of(bumpy(2, 2))},
          {"bumpy ball with itself", mesh_of(bumpy(2, 3)), mesh_of(bumpy(2, 3))},
          {"star + tunnel", star, tunnel_mesh},
          {"stars", star, random_solids::valid_polyhedron(random)}};
}

/// Moves of many kinds, one after the other.
class Moves {
 public:
  explicit Moves(std::uint64_t seed) : random_(seed) {}

  spatial::PosePair next(spatial::PosePair at) {
    SolidPose& pose = below(3) == 0 ? at.q : at.p;
    switch (below(9)) {
      case 0:
        pose.rotation = any_rotation();
        break;
      case 1:
        pose.rotation = quarter_turn();
        break;
      case 2:
        pose.rotation = *Rotation::of(below(7) - std::int64_t{3}, below(7) - std::int64_t{3}, 1 + below(4), 2);
        break;
      case 3:
        pose.scale = {scale(), scale(), scale()};
        break;
      case 4: {
        const Scale s = scale();
        pose.scale = {s, s, s};
        break;
      }
      case 5:
        break;  // stands still
      default:
        pose.rotation = turned(pose.rotation, std::ldexp(1, -static_cast<int>(below(25))));
    }
    return at;
  }
  Rotation turned(const Rotation& from, double angle) {
    return *Rotation::nearest(1, angle * number(), angle * number(), angle * number()) * from;
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

 private:
  double number() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
  Rotation any_rotation() { return *Rotation::nearest(number(), number(), number(), number()); }
  Rotation quarter_turn() {
    const std::int64_t w = below(2), x = below(2), y = below(2);
    return *Rotation::of(w, x, y, w + x + y == 0 ? 1 : below(2));
  }
  Scale scale() { return *Scale::parse(std::to_string(1 + below(6)) + "/" + std::to_string(1 + below(4))); }

  std::mt19937_64 random_;
};

}  // namespace dymsum::moving_cases
