// The generators: facet counts, validity, convexity, grid, symmetry.
#include "dymsum/solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "dymsum/shapes.h"

namespace dymsum::spatial_test {
namespace {

/// Triangles only, as many as said, valid, convex, a sphere's Euler number; where it is snapped, on that grid.
void expect_solid(const Mesh& mesh, std::size_t triangles, const std::string& what, double snap = 0) {
  EXPECT_EQ(mesh.faces().size(), triangles) << what;
  EXPECT_EQ(mesh.triangle_count(), triangles) << what;
  EXPECT_EQ(mesh.vertices().size() + mesh.faces().size(), mesh.edge_count() + 2) << what;
  EXPECT_TRUE(Mesh::create(mesh.data()).ok()) << what;
  EXPECT_EQ(convexity_error(mesh), std::nullopt) << what;
  for (const Point3& p : mesh.vertices()) {
    for (const double c : {p.x, p.y, p.z}) EXPECT_TRUE(snap == 0 || c / snap == std::round(c / snap)) << what;
  }
}

TEST(Solids, ThesisModelsHaveTheirFacetCounts) {
  const std::map<std::string, std::size_t> known = {
      {"cone", 78}, {"cube", 12}, {"cylinder", 140}, {"DD", 32}, {"ellipse", 960}, {"GS1", 80},   {"GS2", 180},
      {"GS3", 320}, {"GS4", 500}, {"HP", 10},        {"T", 60},  {"TI", 236},      {"v-rod", 324}};
  const auto models = solids::thesis_models();
  EXPECT_EQ(models.size(), known.size());
  for (const solids::NamedMesh& model : models) {
    expect_solid(model.mesh, known.at(std::string(model.name)), std::string(model.name), solids::kDemoSnap);
  }
}

/// All of them with this snap.
void expect_all_generators(double snap) {
  for (const int n : {3, 4, 5, 7, 8, 12, 31, 64, 100}) {
    const auto s = static_cast<std::size_t>(n);
    for (const double size : {0.125, 1.0, 3.7, 1000.0}) {
      expect_solid(solids::cone(n, size, size, snap), 2 * s - 2, "cone", snap);
      expect_solid(solids::pyramid(n, size, 2 * size, snap), 2 * s - 2, "pyramid", snap);
      expect_solid(solids::cylinder(n, size, 2 * size, snap), 4 * s - 4, "cylinder", snap);
      expect_solid(solids::dipyramid(n, size, 2 * size, snap), 2 * s, "dipyramid", snap);
    }
  }
  for (const std::size_t f : {1, 2, 3, 6, 9}) {
    expect_solid(solids::geodesic_sphere(static_cast<int>(f), 2.5, snap), 20 * f * f, "geodesic_sphere", snap);
    expect_solid(solids::tessellated_cube(1.3, static_cast<int>(f), snap), 12 * f * f, "tessellated_cube", snap);
  }
  for (const int slices : {3, 8, 21}) {
    for (const int stacks : {3, 5, 9}) {
      const auto count = 2 * static_cast<std::size_t>(slices * (stacks - 1));
      expect_solid(solids::ellipsoid(slices, stacks, 1, 2, 3, snap), count, "ellipsoid", snap);
      expect_solid(solids::rod(slices, stacks, 0.5, 3, snap), count, "rod", snap);
    }
  }
  expect_solid(solids::triakis_icosahedron(7, snap), 60, "triakis_icosahedron", snap);
  expect_solid(solids::truncated_icosidodecahedron(7, snap), 236, "truncated_icosidodecahedron", snap);
}

TEST(Solids, EveryGeneratorAtManySizes) {
  expect_all_generators(0);
  expect_all_generators(solids::kDemoSnap);
}

TEST(Solids, CoordinatesThatAreGivenAreTheCoordinatesOfTheMesh) {
  const std::array<double, 6> given{0.1, -1.0 / 3, 1e-300, 0.7, 1e17, 2e-300};
  EXPECT_EQ(bounds(solids::box(0.1, -1.0 / 3, 1e-300, 0.7, 1e17, 2e-300)), given);
  EXPECT_EQ(bounds(solids::prism({{0, 0}, {0.1, 0}, {0, 0.2}}, 0.3)), (std::array<double, 6>{0, 0, 0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(bounds(solids::tessellated_cube(0.1, 3)), (std::array<double, 6>{-0.05, -0.05, -0.05, 0.05, 0.05, 0.05}));
  EXPECT_EQ(bounds(solids::cone(8, 0.1, 0.7)), (std::array<double, 6>{-0.1, -0.1, 0, 0.1, 0.1, 0.7}));
  EXPECT_EQ(bounds(solids::cylinder(8, 0.1, 0.7))[5], 0.7);
  EXPECT_EQ(bounds(solids::dipyramid(100, 0x1p-18, 0x1p-700)),
            (std::array<double, 6>{-0x1p-18, -0x1p-18, -0x1p-700, 0x1p-18, 0x1p-18, 0x1p-700}));
  EXPECT_EQ(bounds(solids::ellipsoid(8, 4, 0.1, 0.2, 0.3)), (std::array<double, 6>{-0.1, -0.2, -0.3, 0.1, 0.2, 0.3}));
}

TEST(Solids, SnapsToTheNearestMultipleOnRequestAlone) {
  EXPECT_EQ(bounds(solids::box(0, 0, 0, 0.1, 1, 1, 0.125))[3], 0.125);
  EXPECT_EQ(bounds(solids::box(0, 0, 0, 0.1, 1, 1, solids::kDemoSnap))[3], 104858 * solids::kDemoSnap);
  EXPECT_THROW(solids::box(0, 0, 0, 1, 1, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(solids::cone(8, 1, 1, -0.5), std::invalid_argument);
  EXPECT_THROW(solids::tessellated_cube(1, 1, std::nan("")), std::invalid_argument);
}

TEST(Solids, VolumesAndBounds) {
  const Mesh box = solids::box(0, 1, 2, 1, 3, 5);
  EXPECT_EQ(box.faces().size(), 6u);
  EXPECT_EQ(volume(box), 6);
  EXPECT_EQ(convexity_error(box), std::nullopt);
  EXPECT_EQ(volume(solids::tessellated_cube(2, 4)), 8);
  EXPECT_EQ(volume(solids::dipyramid(4, 1, 1)), 4.0 / 3);
  EXPECT_EQ(volume(solids::cylinder(4, 1, 3)), 6);
  EXPECT_EQ(volume(solids::cone(4, 1, 3)), 2);
  const Mesh channel = solids::prism(shapes::letter_u(4, 4, 1).parts().front().outer, 5);
  EXPECT_EQ(channel.faces().size(), 10u);
  EXPECT_EQ(volume(channel), 50);
  EXPECT_EQ(solids::prism({{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 3).canonical(), solids::box(0, 0, 0, 1, 2, 3).canonical());
  const double ball = 4 * std::acos(-1.0) / 3;
  EXPECT_NEAR(volume(solids::geodesic_sphere(12, 1)), ball, 0.02 * ball);
  EXPECT_NEAR(volume(solids::ellipsoid(64, 32, 1, 2, 0.5)), ball, 0.01 * ball);
  EXPECT_EQ(bounds(solids::rod(8, 5, 0.5, 3)), (std::array<double, 6>{-0.5, -0.5, -2, 0.5, 0.5, 2}));
}

// The Catalan solid and the Archimedean one, up to the grid: equal radii and equal edges show it.
TEST(Solids, ArchimedeanRadiiAreEqual) {
  const Mesh archimedean = solids::truncated_icosidodecahedron(1), catalan = solids::triakis_icosahedron(1);
  for (const Point3& p : archimedean.vertices()) {
    EXPECT_NEAR(std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z), 1, 0x1p-18);
  }
  std::map<long, int> radii;
  for (const Point3& p : catalan.vertices()) {
    ++radii[std::lround(1e4 * std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z))];
  }
  EXPECT_EQ(radii.size(), 2u);
  EXPECT_EQ(radii.rbegin()->second, 12);
  EXPECT_EQ(radii.begin()->second, 20);
}

TEST(Solids, BadArgumentsThrow) {
  EXPECT_THROW(solids::cone(2, 1, 1), std::invalid_argument);
  EXPECT_THROW(solids::cone(3, 0, 1), std::invalid_argument);
  EXPECT_THROW(solids::rod(8, 4, 1, 1), std::invalid_argument);
  EXPECT_THROW(solids::box(0, 0, 0, 1, 0, 1), std::invalid_argument);
  EXPECT_THROW(solids::box(0, 0, 0, -1, 1, 1), std::invalid_argument);
  EXPECT_THROW(solids::prism({{0, 0}, {1, 0}, {0, 1}}, 0), std::invalid_argument);
  EXPECT_THROW(solids::prism({{0, 0}, {0, 1}, {1, 0}}, 1), std::invalid_argument);  // clockwise
  EXPECT_THROW(solids::prism({{0, 0}, {1, 0}}, 1), std::invalid_argument);
  EXPECT_THROW(solids::prism({}, 1), std::invalid_argument);
  EXPECT_THROW(solids::tessellated_cube(1, 0), std::invalid_argument);
  EXPECT_THROW(solids::geodesic_sphere(0, 1), std::invalid_argument);
  EXPECT_THROW(solids::dipyramid(100, 0x1p-18, 1, 0x1p-20), std::invalid_argument);  // finer than the grid
}

}  // namespace
}  // namespace dymsum::spatial_test
