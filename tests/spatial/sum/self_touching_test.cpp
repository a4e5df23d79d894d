// Operands that touch themselves: unions of some tetrahedra of a complex, with edges of four and more faces, vertices
// of several fans, and pits whose rims touch. Their sum is the union of the convex sums of the tetrahedra.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using random_solids::boundary, random_solids::det, random_solids::minus, random_solids::random_complex;
using random_solids::six_volume, random_solids::Tetrahedron;

Mesh solid_of(const Tetrahedron& t) {
  return Mesh::create({{t[0], t[1], t[2], t[3]}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}).value();
}

/// How often the triangles go round a point that is not near them.
double winding(const MeshData& mesh, Point3 x) {
  double angle = 0;
  for (const Face& f : mesh.faces) {
    const Point3 a = minus(mesh.vertices[f[0]], x), b = minus(mesh.vertices[f[1]], x),
                 c = minus(mesh.vertices[f[2]], x);
    const auto dot = [](Point3 u, Point3 v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    angle += 2 * std::atan2(det(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

TEST(SelfTouching, sums_are_the_unions_of_convex_sums) {
  int solids = 0, inside = 0, outside = 0;
  for (int k = 0; k < fuzz_pairs(40, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const int scale = 2 + static_cast<int>(random() % 2);
    const std::vector<Tetrahedron> complex = random_complex(random, k % 4 == 0 ? 2 : 1, scale);
    const Result<Mesh> p = Mesh::create(boundary(complex));
    if (!p.ok() || complex.empty()) continue;  // moved vertices may touch what they should not
    std::vector<Tetrahedron> parts = random_complex(random, 1, scale);
    parts.resize(std::min<std::size_t>(parts.size(), 1));
    if (parts.empty() || six_volume(parts[0]) == 0) continue;
    const Mesh q = solid_of(parts[0]);
    const SpatialSum s = sum(p->data(), q.data());
    EXPECT_TRUE(s == sum(q.data(), p->data())) << "seed " << k;
    EXPECT_TRUE(s == sum(p->data(), q.data(), SpatialEngine::brute)) << "seed " << k;
    ++solids;
    std::vector<MeshData> convex;
    for (const Tetrahedron& t : complex) convex.push_back(minkowski_sum(solid_of(t), q).value().rounded().value().mesh);
    const MeshData all = s.rounded().value().mesh;
    std::uniform_real_distribution<double> position(-0.5, 4.0 * scale);
    for (int i = 0; i < 40; ++i) {
      const Point3 x{position(random), position(random), position(random)};
      bool covered = false;
      for (const MeshData& c : convex) covered |= winding(c, x) > 0.5;
      EXPECT_EQ(winding(all, x) > 0.5, covered) << "seed " << k << " at " << x.x << " " << x.y << " " << x.z;
      ++(covered ? inside : outside);
    }
  }
  EXPECT_GT(solids, 10);
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

// A pit open along one edge only, where it touches the outside: an edge of four faces that one fan goes by twice.
TEST(SelfTouching, a_pit_whose_rim_touches_the_outside_keeps_its_surface) {
  const Mesh pit = Mesh::create({{{1, 0, 0}, {0, 0, 2}, {0, 1, 0}, {1, 0, 1}, {0, 2, 0}, {1, 1, 1}},
                                 {{0, 1, 2},
                                  {0, 2, 3},
                                  {0, 3, 1},
                                  {2, 4, 0},
                                  {2, 0, 5},
                                  {0, 4, 5},
                                  {2, 1, 4},
                                  {4, 1, 5},
                                  {1, 3, 5},
                                  {2, 5, 3}}})
                       .value();
  const Mesh corner =
      Mesh::create({{{0, 0, 0}, {0, 0, 2}, {0, 1, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {0, 3, 1}}})
          .value();
  EXPECT_EQ(sum(pit.data(), corner.data()).volume_exact().to_string(), "203/24");
  EXPECT_EQ(sum(corner.data(), pit.data()).volume_exact().to_string(), "203/24");
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  EXPECT_TRUE(sum(pit.data(), cube.data()) == sum(cube.data(), pit.data()));
  // Whichever way the axes, and so the ties, run.
  for (const auto& [i, j, k] : {std::array<int, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}})
    for (int signs = 0; signs < 8; ++signs) {
      const auto turned = [&, i = i, j = j, k = k](const Mesh& mesh) {
        MeshData data = mesh.data();
        for (Point3& v : data.vertices) {
          const std::array<double, 3> c{v.x, v.y, v.z};
          v = {(signs & 1 ? -1 : 1) * c[static_cast<std::size_t>(i)],
               (signs & 2 ? -1 : 1) * c[static_cast<std::size_t>(j)],
               (signs & 4 ? -1 : 1) * c[static_cast<std::size_t>(k)]};
        }
        const bool odd = ((i + 1) % 3 != j) != (signs == 1 || signs == 2 || signs == 4 || signs == 7);
        if (odd)
          for (Face& f : data.faces) std::reverse(f.begin(), f.end());
        return Mesh::create(data).value();
      };
      EXPECT_EQ(sum(turned(pit).data(), turned(corner).data()).volume_exact().to_string(), "203/24")
          << i << j << k << " " << signs;
    }
}

}  // namespace
}  // namespace dymsum
