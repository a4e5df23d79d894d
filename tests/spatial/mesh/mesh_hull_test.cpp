// Hulls of nearly convex meshes, and solids that stay convex where they are moved and rounded.
#include <cmath>

#include "exact/big.h"
#include "spatial/convex/convex_cases.h"

namespace dymsum::test {
namespace {

/// A cube of side 2 about the origin whose top has a middle at this height.
MeshData with_midpoint(double height) {
  MeshData data = cube(1).data();
  data.vertices.push_back({0, 0, height});
  const Face top = *std::find_if(data.faces.begin(), data.faces.end(), [&](const Face& f) {
    return std::all_of(f.begin(), f.end(), [&](std::uint32_t v) { return data.vertices[v].z == 1; });
  });
  std::erase(data.faces, top);
  for (std::size_t i = 0; i < 4; ++i) data.faces.push_back({top[i], top[(i + 1) % 4], 8});
  return data;
}

TEST(MeshHull, the_deviation_is_that_of_the_deepest_place) {
  for (const double depth : {0x1p-52, 0x1p-30, 0.25, 1.0}) {
    const HulledMesh hull = *hulled(with_midpoint(1 - depth));
    EXPECT_EQ(hull.mesh, cube(1));
    EXPECT_EQ(hull.report.vertices, 9u);
    EXPECT_EQ(hull.report.inside_vertices, 1u);
    EXPECT_EQ(hull.report.deviation, depth);
  }
  EXPECT_EQ(hulled(with_midpoint(1))->report.deviation, 0) << "flat is not inside";
  EXPECT_EQ(hulled(with_midpoint(1))->report.inside_vertices, 0u);
  EXPECT_EQ(hulled(with_midpoint(1.5))->report.deviation, 0);
  const double tiny = 0x1p-1060;
  MeshData small = with_midpoint(0.5);
  for (Point3& p : small.vertices) p = {tiny * p.x, tiny * p.y, tiny * p.z};
  EXPECT_EQ(hulled(small)->report.deviation, 0.5 * tiny);
}

TEST(MeshHull, a_depth_of_more_units_of_the_grid_than_doubles_count_is_a_number) {
  for (const double size : {1.0, 0x1p1000}) {
    MeshData data;
    for (const Point3& p : {Point3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0.25, 1, 1}})
      data.vertices.push_back({size * p.x, size * p.y, size * p.z});
    data.vertices.push_back({0x1p-1074, size, size});
    const HullReport report = hulled(data)->report;
    EXPECT_EQ(report.inside_vertices, 2u);
    EXPECT_EQ(report.deviation, 0.25 * size);
  }
}

TEST(MeshHull, an_edge_below_the_hull_counts_although_all_vertices_are_corners) {
  // A tetrahedron whose two back faces meet in the other diagonal: all four vertices are corners.
  const std::vector<Point3> at{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 4}, {1, 1, -1}};
  MeshData data{at, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  EXPECT_EQ(hulled(data)->report.deviation, 0);
  data.faces[0] = {0, 1, 2};  // below the tip
  data.faces[1] = {0, 2, 4};
  const HullReport report = hulled(data)->report;
  EXPECT_EQ(report.inside_vertices, 0u);
  EXPECT_GT(report.deviation, 0);
}

TEST(MeshHull, of_points_it_is_the_depth_of_the_deepest_one) {
  std::vector<Point3> points = cube(1).vertices();
  EXPECT_EQ(hulled({points, {}})->report.deviation, 0);
  points.push_back({0, 1 - 0x1p-52, 0});
  EXPECT_EQ(hulled({points, {}})->report.deviation, 0x1p-52);
  points.push_back({0.25, 0, 0});
  points.push_back({0, 0, 1});
  const HullReport report = hulled({points, {}})->report;
  EXPECT_EQ(report.deviation, 0.75);
  EXPECT_EQ(report.inside_vertices, 2u) << "the third one is on a face";
  MeshData solid = cube(1).data();
  solid.vertices.push_back({0, 0, 0});
  EXPECT_EQ(hulled(solid)->report.deviation, 0) << "no face uses the middle";
}

TEST(MeshHull, of_convex_solids_changes_nothing) {
  for (const solids::NamedMesh& m : solids::thesis_models()) {
    const HulledMesh hull = *hulled(m.mesh.data());
    EXPECT_EQ(hull.mesh, m.mesh) << m.name;
    EXPECT_EQ(hull.report.deviation, 0) << m.name;
    EXPECT_EQ(hull.report.inside_vertices, 0u) << m.name;
  }
}

TEST(MeshHull, what_no_face_uses_is_left_out_and_bad_data_is_told) {
  MeshData data = cube(1).data();
  data.vertices.push_back({9, 9, 9});
  EXPECT_EQ(hulled(data)->mesh, cube(1));
  EXPECT_EQ(hulled(data)->report.unused_vertices, 1u);
  EXPECT_EQ(hulled({data.vertices, {}})->mesh.vertices().size(), 8u) << "points: 7 corners and the far one";
  EXPECT_EQ(hulled({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}).error().code, ErrorCode::no_area);
  EXPECT_EQ(hulled({{{0, 0, std::nan("")}}, {}}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(hulled({{{0, 0, 0}}, {{0, 1, 2}}}).error().code, ErrorCode::bad_index);
}

TEST(MeshHull, a_moved_solid_stays_convex_and_says_how_far_it_is_off) {
  const Mesh ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap);
  const HulledMesh exact = *translated_hull(ball, 3, -5, 0.5);
  EXPECT_EQ(exact.report.deviation, 0);
  EXPECT_EQ(exact.mesh, *translated(ball, 3, -5, 0.5));
  const HulledMesh far = *translated_hull(ball, 0x1p40 + 0.1, 1e9 / 3, -7e11);
  EXPECT_EQ(convexity_error(far.mesh), std::nullopt);
  EXPECT_GT(far.report.deviation, 0);
  EXPECT_LE(far.report.deviation, std::sqrt(3.0) * 0x1p-13);
  EXPECT_EQ(translated_hull(ball, 0x1p80, 0, 0).error().code, ErrorCode::no_area);
  EXPECT_EQ(translated_hull(ball, INFINITY, 0, 0).error().code, ErrorCode::not_finite);
  EXPECT_EQ(translated_hull(*Mesh::create(with_midpoint(0.5)), 0, 0, 0).error().code, ErrorCode::not_convex);
}

TEST(ConvexSumChain, of_three_solids_is_the_same_in_every_order) {
  std::mt19937_64 random(41);
  for (int k = 0; k < 25; ++k) {
    const std::vector<Mesh> solids{random_grid_polytope(random, 5 + k % 4, 3),
                                   random_grid_polytope(random, 5, 3, 0x1p-40),
                                   random_grid_polytope(random, 4 + k % 5, 2, 3)};
    const SpatialSum sum = *minkowski_sum(solids),
                     other = *minkowski_sum(std::vector<Mesh>{solids[2], solids[0], solids[1]});
    EXPECT_EQ(sum.volume_exact(), other.volume_exact()) << k;
    EXPECT_EQ(sum.faces.size(), other.faces.size()) << k;
    EXPECT_EQ(sum, other) << k;
    expect_closed(sum);
    std::vector<Point3> at;
    for (const Point3& a : solids[0].vertices())
      for (const Point3& b : solids[1].vertices())
        for (const Point3& c : solids[2].vertices()) at.push_back({a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z});
    EXPECT_EQ(*sum.rounded_mesh(), *convex_hull(at)) << k << ": these are doubles";
  }
}

TEST(ConvexSumChain, needs_more_bits_than_doubles_have) {
  // Unit cubes at 2^50, then boxes of 2^-30 and 2^-60: 110 bits, and exact.
  const Mesh far = free_box({0x1p50, 0, 0}, {0x1p50 + 1, 1, 1});
  const std::vector<Mesh> solids{far, *scaled(cube(1), 0x1p-30, 0x1p-30, 0x1p-30),
                                 *scaled(cube(1), 0x1p-60, 0x1p-60, 0x1p-60)};
  const SpatialSum sum = *minkowski_sum(solids);
  const exact::BigRational side = exact::exact_value(1 + 0x1p-29) + exact::exact_value(0x1p-59);
  EXPECT_EQ(exact::exact_value(sum.volume_exact()), side * side * side);
  EXPECT_EQ(sum.faces.size(), 6u);
  EXPECT_EQ(minkowski_sum(std::vector<Mesh>{far})->volume_exact(), *Rational::of(1, 1));
  const SpatialSum turned = *convex_sum(far, far, {*Rotation::of(2, 1, 0, 0), {}});
  EXPECT_EQ(ConvexSum::create(turned, far).error().code, ErrorCode::unsupported_operand) << "fifths";
  const SpatialSum quarter = *convex_sum(far, far, {*Rotation::of(1, 1, 0, 0), {}});
  EXPECT_TRUE(ConvexSum::create(quarter, far).ok());
}

TEST(RoundedSum, is_a_valid_convex_mesh_within_its_deviation_or_refused) {
  std::mt19937_64 random(42);
  for (int k = 0; k < 30; ++k) {
    const Mesh p = random_round_polytope(random, 20), q = random_round_polytope(random, 15);
    const SpatialSum sum = *convex_sum(p, q, {random_rotation(random), {}});
    for (const Precision precision : {Precision::doubles, Precision::singles}) {
      const Result<Mesh> mesh = sum.rounded_mesh(precision);
      const HulledMesh hull = *sum.rounded_hull(precision);
      EXPECT_EQ(convexity_error(hull.mesh), std::nullopt);
      EXPECT_LE(hull.report.deviation, precision == Precision::doubles ? 0x1p-51 : 0x1p-22);
      EXPECT_GT(hull.report.deviation, 0);
      if (mesh) {
        EXPECT_EQ(mesh->data(), hull.mesh.data());
        EXPECT_EQ(mesh->vertices().size(), sum.vertices.size());
      } else {
        EXPECT_EQ(mesh.error().code, ErrorCode::rounding_changed_topology);
      }
    }
  }
  const Mesh far = free_box({0x1p50, 0, 0}, {0x1p50 + 1, 1, 1});
  const Result<Mesh> collapsed =
      convex_sum(far, *scaled(solids::dipyramid(4, 1, 1, solids::kDemoSnap), 0x1p-30, 0x1p-30, 0x1p-30))
          ->rounded_mesh();
  ASSERT_FALSE(collapsed);
  EXPECT_EQ(collapsed.error().code, ErrorCode::rounding_changed_topology);
  EXPECT_TRUE(collapsed.error().evidence.vertex && collapsed.error().evidence.x);
  const Mesh huge = free_box({0, 0, 0}, {0x1p1023, 0x1p1023, 0x1p1023});
  EXPECT_EQ(convex_sum(huge, huge)->rounded_mesh().error().code, ErrorCode::not_finite);
  EXPECT_EQ(convex_sum(huge, cube(1))->rounded_mesh(Precision::singles).error().code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace dymsum::test
