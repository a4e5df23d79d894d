// Sums with operands without volume: points, segments, polylines, plates, open surfaces, and solids that have such
// parts.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using oracles::LatticeCells;
using oracles::Voxels;

Mesh thin(MeshData data) {
  const Result<Mesh> mesh = Mesh::with_thin_parts(std::move(data));
  EXPECT_TRUE(mesh.ok()) << (mesh.ok() ? "" : mesh.error().to_string());
  return mesh.ok() ? *mesh : Mesh{};
}

/// The regular part as a mesh.
Mesh regular_part(const SpatialSum& s) { return Mesh::create(s.rounded().value().mesh).value(); }

double tight_length(const SpatialSum& s) {
  double total = 0;
  for (const auto& [a, b] : s.tight_segments) {
    const Point3 &p = s.vertices[a], &q = s.vertices[b];
    total += std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
  }
  return total;
}

Mesh random_solid(std::uint64_t seed, const oracles::IntegerMap& map = oracles::kNoShear) {
  std::mt19937_64 random(seed);
  return Mesh::create(oracles::voxel_mesh(oracles::random_voxels(3, random)[0], map)).value();
}

TEST(ThinOperands, with_a_point_are_the_other_one_moved) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Mesh p = random_solid(seed);
    const Mesh point = thin({{{3, -1, 0.5}}, {{0}}});
    const SpatialSum s = sum(p, point);
    EXPECT_TRUE(regular_part(s) == regular_part(sum(translated(p, 3, -1, 0.5).value(), thin({{{0, 0, 0}}, {{0}}}))))
        << seed;
    EXPECT_EQ(s.volume(), volume(p)) << seed;
    EXPECT_TRUE(s.tight_faces.empty() && s.tight_segments.empty() && s.tight_points.empty()) << seed;
    EXPECT_TRUE(s == sum(point, p)) << seed;
  }
}

TEST(ThinOperands, convex_ones_give_the_hull_of_all_sums) {
  const std::vector<Mesh> parts{thin({{{0, 0, 0}, {1, 2, 3}}, {{0, 1}}}), thin({{{0, 0, 0}, {2, 0, 0}}, {{0, 1}}}),
                                thin({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}}),
                                thin({{{0, 0, 0}, {1, 0, 3}, {-1, 2, 1}}, {{0, 1, 2}}})};
  for (const Mesh& solid : {solids::box(0, 0, 0, 1, 2, 3), solids::cone(7, 1, 2, solids::kDemoSnap),
                            solids::geodesic_sphere(1, 1, solids::kDemoSnap)}) {
    for (const Mesh& part : parts) {
      std::vector<Point3> sums;
      for (const Point3& a : solid.vertices())
        for (const Point3& b : part.vertices()) sums.push_back({a.x + b.x, a.y + b.y, a.z + b.z});
      const SpatialSum s = sum(solid, part);
      EXPECT_TRUE(regular_part(s) == convex_hull(sums).value());
      EXPECT_TRUE(s == sum(part, solid));
      EXPECT_TRUE(s == sum(solid, part, SpatialEngine::brute));
    }
  }
}

TEST(ThinOperands, a_wire_as_long_as_a_cavity_is_wide_leaves_a_tight_face) {
  MeshData shell = solids::box(-3, -3, -3, 3, 3, 3).data();
  const MeshData inner = solids::box(-1, -1, -1, 1, 1, 1).data();
  shell.vertices.insert(shell.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const Face& f : inner.faces) {
    shell.faces.emplace_back(f.rbegin(), f.rend());
    for (std::uint32_t& v : shell.faces.back()) v += 8;
  }
  const Mesh hollow = Mesh::create(shell).value();
  const SpatialSum face = sum(hollow, thin({{{-1, 0, 0}, {1, 0, 0}}, {{0, 1}}}));
  EXPECT_EQ(face.tight_faces.size(), 1u);
  EXPECT_EQ(tight_area(face), 4);
  EXPECT_EQ(face.volume(), 8 * 6 * 6);
  const SpatialSum segment = sum(hollow, thin({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}}}));
  EXPECT_TRUE(segment.tight_faces.empty());
  EXPECT_EQ(tight_length(segment), 2);
  // a bent wire that spans the cavity along all axes
  const SpatialSum point =
      sum(hollow, thin({{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {1, 1, 1}}, {{0, 1}, {1, 2}, {2, 3}}}));
  EXPECT_TRUE(point.tight_faces.empty() && point.tight_segments.empty());
  ASSERT_EQ(point.tight_points.size(), 1u);
  EXPECT_EQ(point.exact(point.tight_points[0]), (RationalPoint3{}));
  EXPECT_EQ(sum(hollow, thin({{{-0.5, 0, 0}, {0.5, 0, 0}}, {{0, 1}}})).shells, 2u);
}

/// Up to five points, segments and squares, perhaps with a cube.
LatticeCells random_cells(std::mt19937_64& random, bool cube) {
  LatticeCells cells;
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  const int count = 1 + below(5);
  while (static_cast<int>(cells.size()) < count) {
    const oracles::Voxel c{below(5), below(5), below(3)};
    if (c[0] % 2 + c[1] % 2 + c[2] % 2 < 3) cells.insert(c);
  }
  if (cube) cells.insert({1, 1, 1});
  return cells;
}

TEST(ThinOperands, of_lattice_cells_and_unions_of_cubes) {
  const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
  int tight = 0, checked = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(60, 3)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(7000 + k));
    const Voxels p = oracles::random_voxels(k % 10 == 0 ? 4 : 3, random)[0];
    const LatticeCells q = random_cells(random, k % 5 == 0);
    const oracles::IntegerMap& map = k % 2 == 0 ? oracles::kNoShear : shear;
    const Mesh solid = Mesh::create(oracles::voxel_mesh(p, map)).value();
    const Result<Mesh> part = Mesh::with_thin_parts(oracles::lattice_mesh(q, map));
    if (!part) continue;  // a square on the cube: edges of three faces
    ++checked;
    const oracles::VoxelSum expected = oracles::lattice_sum(p, q);
    const SpatialSum s = sum(solid, *part);
    const std::string seed = "seed " + std::to_string(7000 + k);
    EXPECT_EQ(s.volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
    EXPECT_EQ(s.tight_points.size(), expected.tight_points) << seed;
    if (k % 2 == 0) {
      EXPECT_EQ(tight_length(s), static_cast<double>(expected.tight_edges)) << seed;
      EXPECT_EQ(tight_area(s), static_cast<double>(expected.tight_faces)) << seed;
    } else {
      EXPECT_EQ(s.tight_segments.empty(), expected.tight_edges == 0) << seed;
      EXPECT_EQ(s.tight_faces.empty(), expected.tight_faces == 0) << seed;
    }
    EXPECT_TRUE(s == sum(*part, solid)) << seed;
    if (k % 3 == 0) {
      EXPECT_TRUE(s == sum(solid, *part, SpatialEngine::brute)) << seed;
    }
    tight += expected.tight_points + expected.tight_edges + expected.tight_faces > 0;
  }
  EXPECT_GT(checked, oracles::rounds(45, 3));
  EXPECT_GT(tight, oracles::rounds(5, 3));
}

TEST(ThinOperands, two_of_them_give_the_volume_that_they_sweep) {
  const Mesh square = thin({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}});
  const Mesh up = thin({{{0, 0, 0}, {1, 0, 3}}, {{0, 1}}}), along = thin({{{0, 0, 0}, {1, 1, 0}}, {{0, 1}}});
  EXPECT_EQ(sum(square, up).volume_exact(), 12);
  EXPECT_TRUE(sum(square, up) == sum(up, square));
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  for (const Mesh& flat : {along, square, thin({{{5, 5, 5}}, {{0}}})}) {
    EXPECT_EQ(minkowski_sum(square, flat).value().tight_faces.size(), 1u);
    const Result<SpatialSum> none = minkowski_sum(square, flat, regular);
    ASSERT_FALSE(none.ok()) << none->faces.size() << " faces, volume " << none->volume();
    EXPECT_EQ(none.error().code, ErrorCode::unsupported_operand);
  }
  EXPECT_EQ(sum(square, thin({{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 2}}})).volume_exact(), 5);
  int some = 0;
  for (int k = 0; k < fuzz_pairs(60); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(9000 + k));
    const LatticeCells a = random_cells(random, k % 7 == 0), b = random_cells(random, k % 11 == 0);
    const std::size_t expected = oracles::volume_of_sums(a, b);
    const Result<Mesh> p = Mesh::with_thin_parts(oracles::lattice_mesh(a)),
                       q = Mesh::with_thin_parts(oracles::lattice_mesh(b));
    if (!p || !q) continue;
    const Result<SpatialSum> s = minkowski_sum(*p, *q, regular);
    EXPECT_EQ(s.ok(), expected > 0) << "seed " << 9000 + k;
    if (!s.ok() || expected == 0) continue;
    ++some;
    EXPECT_EQ(s->volume_exact(), static_cast<std::int64_t>(expected)) << "seed " << 9000 + k;
    const Result<SpatialSum> reversed = minkowski_sum(*q, *p, regular);
    ASSERT_TRUE(reversed.ok()) << "seed " << 9000 + k;
    EXPECT_TRUE(*s == *reversed) << "seed " << 9000 + k;
  }
  EXPECT_GT(some, 20);
}

}  // namespace
}  // namespace dymsum
