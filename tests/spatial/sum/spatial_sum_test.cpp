// Sums of solids of any shape: known answers, laws, and unions of cubes against lattice cells.
#include "dymsum/spatial_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "dymsum/solids.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using spatial::sum_of_solids;

TEST(SpatialSum, of_two_cubes_is_a_cube) {
  const SpatialSum s = sum(box(1), box(2));
  EXPECT_EQ(s.volume_exact().to_string(), "216/1");
  EXPECT_EQ(s.faces.size(), 6u);
  EXPECT_EQ(s.vertices.size(), 8u);
  EXPECT_EQ(s.shells, 1u);
}

TEST(SpatialSum, of_convex_solids_is_the_same_the_short_way) {
  const std::vector<Mesh> convex{solids::box(-1, -1, -1, 1, 1, 1),
                                 solids::tessellated_cube(2, 2, solids::kDemoSnap),
                                 solids::cone(7, 1, 2, solids::kDemoSnap),
                                 solids::dipyramid(6, 1, 1.5, solids::kDemoSnap),
                                 solids::geodesic_sphere(2, 1, solids::kDemoSnap),
                                 solids::truncated_icosidodecahedron(1, solids::kDemoSnap)};
  SpatialOptions brute;
  brute.engine = SpatialEngine::brute;
  for (std::size_t i = 0; i < convex.size(); ++i)
    for (std::size_t j = 0; j <= i && i + j < 8; ++j) {
      const SpatialSum direct = minkowski_sum(convex[i], convex[j]).value();
      EXPECT_EQ(direct.stats.cells, 0u) << "the general way was taken";
      const SpatialSum general = sum(convex[i].data(), convex[j].data());
      EXPECT_TRUE(direct == general) << i << ", " << j;
      EXPECT_TRUE(direct == minkowski_sum(convex[j], convex[i]).value()) << i << ", " << j;
      EXPECT_EQ(direct.volume_exact(), general.volume_exact());
      EXPECT_EQ(direct.shells, 1u);
      EXPECT_EQ(direct.rounded().value().mesh.vertices.size(), general.rounded().value().mesh.vertices.size());
      for (std::size_t k = 0; k < direct.vertices.size(); ++k)
        EXPECT_EQ(direct.vertices[k].x, direct.exact(k).x.to_double());
    }
  EXPECT_TRUE(minkowski_sum(convex[0], convex[2]).value() == minkowski_sum(convex[0], convex[2], brute).value());
}

TEST(SpatialSum, of_convex_solids_has_any_size) {
  const auto cube = [](double size) { return scaled(solids::box(0, 0, 0, 1, 1, 1), size, size, size).value(); };
  const SpatialSum both = minkowski_sum(cube(0x1p-300), cube(0x1p300)).value();
  const Rational side = *Rational::of(0x1p-300) + *Rational::of(0x1p300);
  EXPECT_EQ(both.volume_exact(), side * side * side);
  EXPECT_EQ(both.exact(7).x, side);
}

TEST(SpatialSum, of_convex_solids_can_be_cancelled) {
  SpatialOptions options;
  options.progress = [](std::string_view, double) { return false; };
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  EXPECT_EQ(minkowski_sum(cube, cube, options).error().code, ErrorCode::cancelled);
}

TEST(SpatialSum, of_an_ell_and_a_cube_wherever_it_lies_and_in_either_order) {
  const MeshData cube = box(0.25);
  EXPECT_EQ(sum(ell(), cube).volume_exact().to_double(), 779.625);
  EXPECT_EQ(sum(ell(), moved(cube, 50, 0, 0)).volume_exact().to_double(), 779.625);
  EXPECT_TRUE(sum(ell(), cube) == sum(cube, ell()));
  EXPECT_EQ(sum(ell(), cube).faces.size(), 8u);
}

TEST(SpatialSum, of_a_tunnel_and_a_peg_of_its_width_keeps_the_way_through) {
  const SpatialSum s = sum(tunnel(), box(1));
  EXPECT_EQ(s.volume_exact().to_string(), "1728/1");
  EXPECT_EQ(s.faces.size(), 6u);
  ASSERT_EQ(s.tight_segments.size(), 1u);
  EXPECT_EQ(length(s, s.tight_segments[0]), 12);
  EXPECT_TRUE(s.tight_faces.empty() && s.tight_points.empty());
}

TEST(SpatialSum, of_a_tunnel_and_a_thinner_peg_has_a_tunnel) {
  const SpatialSum s = sum(tunnel(), box(0.95));
  EXPECT_NEAR(s.volume(), 1685.04, 1e-9);
  EXPECT_EQ(s.faces.size(), 10u);
  EXPECT_EQ(s.vertices.size(), 16u);
  EXPECT_TRUE(s.tight_segments.empty());
}

TEST(SpatialSum, of_a_tunnel_and_a_plate_as_high_is_a_tight_face) {
  const SpatialSum s = sum(tunnel(), solids::box(-1, -1, -0.5, 1, 1, 0.5).data());
  ASSERT_EQ(s.tight_faces.size(), 1u);
  EXPECT_EQ(tight_area(s), 12);
  EXPECT_TRUE(s.tight_segments.empty());
}

TEST(SpatialSum, of_a_cavity_and_its_key_is_a_tight_point) {
  const SpatialSum s = sum(cavity(), box(1));
  EXPECT_EQ(s.volume_exact().to_string(), "1728/1");
  ASSERT_EQ(s.tight_points.size(), 1u);
  EXPECT_EQ(s.exact(s.tight_points[0]), (RationalPoint3{}));
  EXPECT_EQ(sum(cavity(), box(0.75)).shells, 2u);
}

/// A blob of triangles between two poles, four rings of vertices around.
MeshData blob(std::vector<Point3> vertices, std::uint32_t around) {
  MeshData m{std::move(vertices), {}};
  const auto top = static_cast<std::uint32_t>(m.vertices.size() - 1);
  const auto id = [&](std::uint32_t i, std::uint32_t j) { return 1 + j * around + i % around; };
  const std::uint32_t rings = (top - 1) / around;
  for (std::uint32_t i = 0; i < around; ++i) {
    m.faces.push_back({0, id(i + 1, 0), id(i, 0)});
    m.faces.push_back({top, id(i, rings - 1), id(i + 1, rings - 1)});
    for (std::uint32_t j = 0; j + 1 < rings; ++j) {
      m.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return m;
}

TEST(SpatialSum, facets_that_touch_a_face_inside_it_leave_no_tight_point) {
  const MeshData p = blob({{0, 0, -2},
                           {1, 0, -1},
                           {1, 2, -2},
                           {-2, 2, -3},
                           {-1, -1, -1},
                           {1, -3, -3},
                           {3, 0, 0},
                           {1, 4, 0},
                           {-2, 1, 0},
                           {-2, -1, 0},
                           {2, -5, 0},
                           {2, 0, 2},
                           {0, 1, 1},
                           {-2, 2, 3},
                           {-1, -1, 1},
                           {1, -2, 2},
                           {0, 0, 4}},
                          5);
  const MeshData q = blob({{0, 0, -3},
                           {2, 0, -1},
                           {1, 1, -1},
                           {-2, 3, -2},
                           {-3, 0, -2},
                           {-2, -3, -2},
                           {2, -3, -2},
                           {3, 0, 1},
                           {1, 2, 1},
                           {-1, 2, 1},
                           {-3, 0, 2},
                           {-2, -3, 2},
                           {1, -2, 1},
                           {0, 0, 2}},
                          6);
  EXPECT_TRUE(sum(p, q).tight_points.empty());
  EXPECT_TRUE(sum(p, q) == sum(q, p));
}

TEST(SpatialSum, with_an_empty_operand_is_empty) {
  EXPECT_TRUE(sum(box(1), MeshData{}).faces.empty());
  EXPECT_TRUE(sum(MeshData{}, box(1)).faces.empty());
}

/// Every edge as often one way as the other, and the volume of the triangles.
void expect_closed(const SpatialSum& s, const std::string& what) {
  const MeshData mesh = s.rounded().value().mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  double six = 0;
  for (const Face& f : mesh.faces) {
    const Point3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
    six += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    for (int k = 0; k < 3; ++k) ++sides[{f[k], f[(k + 1) % 3]}], --sides[{f[(k + 1) % 3], f[k]}];
  }
  for (const auto& [edge, count] : sides) EXPECT_EQ(count, 0) << what;
  EXPECT_NEAR(six / 6, s.volume(), 1e-9 * s.volume() + 1e-12) << what;
}

TEST(SpatialSum, as_triangles_is_closed_and_of_the_same_volume) {
  expect_closed(sum(tunnel(), box(0.95)), "faces with holes");
  expect_closed(sum(cavity(), box(0.5)), "two shells");
  EXPECT_TRUE(Mesh::create(sum(tunnel(), box(0.95)).rounded().value().mesh).ok());
  for (int k = 0; k < fuzz_pairs(12); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(500 + k));
    const auto [p, q] = oracles::random_voxels(k % 8 == 0 ? 4 : 3, random);
    expect_closed(sum(oracles::voxel_mesh(p), oracles::voxel_mesh(q)), "seed " + std::to_string(500 + k));
  }
}

TEST(SpatialSum, of_unions_of_cubes_is_that_of_lattice_cells) {
  const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
  int tight = 0;
  for (int k = 0; k < fuzz_pairs(60); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const auto [p, q] = oracles::random_voxels(k % 10 == 0 ? 3 : 2, random);
    const oracles::VoxelSum expected = oracles::voxel_sum(p, q);
    const oracles::IntegerMap& map = k % 2 == 0 ? oracles::kNoShear : shear;
    const SpatialSum s = sum(oracles::voxel_mesh(p, map), oracles::voxel_mesh(q, map));
    EXPECT_EQ(s.volume_exact(), static_cast<std::int64_t>(expected.volume)) << "seed " << k;
    EXPECT_EQ(s.tight_points.size(), expected.tight_points) << "seed " << k;
    EXPECT_EQ(s.tight_segments.empty(), expected.tight_edges == 0) << "seed " << k;
    EXPECT_EQ(s.tight_faces.empty(), expected.tight_faces == 0) << "seed " << k;
    if (k % 2 == 0) {
      double edges = 0;
      for (const auto& segment : s.tight_segments) edges += length(s, segment);
      EXPECT_EQ(edges, static_cast<double>(expected.tight_edges)) << "seed " << k;
      EXPECT_EQ(tight_area(s), static_cast<double>(expected.tight_faces)) << "seed " << k;
    }
    tight += expected.tight_points + expected.tight_edges + expected.tight_faces > 0;
  }
  EXPECT_GT(tight, 5);
}

TEST(SpatialSum, by_both_engines_and_in_either_order_is_the_same) {
  for (int k = 0; k < fuzz_pairs(15); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(1000 + k));
    const auto [a, b] = oracles::random_voxels(2, random);
    const MeshData p = oracles::voxel_mesh(a), q = oracles::voxel_mesh(b);
    const SpatialSum s = sum(p, q);
    EXPECT_TRUE(s == sum(p, q, SpatialEngine::brute)) << "seed " << k;
    EXPECT_TRUE(s == sum(q, p)) << "seed " << k;
  }
}

}  // namespace
}  // namespace dymsum
