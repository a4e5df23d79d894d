// Which meshes are convex, and why others are not.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

Mesh solid_of(MeshData data) {
  Result<Mesh> mesh = Mesh::create(std::move(data));
  EXPECT_TRUE(mesh.ok()) << mesh.error().to_string();
  return mesh.ok() ? std::move(mesh).value() : Mesh{};
}

TEST(Convexity, GeneratedSolidsAreConvexInEveryForm) {
  for (const solids::NamedMesh& model : solids::thesis_models()) {
    EXPECT_EQ(convexity_error(model.mesh), std::nullopt) << model.name;
    EXPECT_EQ(convexity_error(model.mesh.canonical()), std::nullopt) << model.name;
    EXPECT_EQ(convexity_error(negated(model.mesh)), std::nullopt) << model.name;
  }
  EXPECT_EQ(convexity_error(solids::tessellated_cube(1, 7, solids::kDemoSnap)), std::nullopt);
}

TEST(Convexity, FlatFacesMayBeConcave) {
  // a cube whose top is an L and a square
  MeshData data = cube(2);
  const auto add = [&](Point3 p) {
    data.vertices.push_back(p);
    return static_cast<std::uint32_t>(data.vertices.size() - 1);
  };
  const std::uint32_t m = add({1, 1, 2}), r = add({2, 1, 2}), b = add({1, 2, 2});
  data.faces[1] = {4, 5, r, m, b, 6};
  data.faces.push_back({m, r, 7, b});
  data.faces[3] = {2, 6, b, 7, 3};
  data.faces[5] = {1, 3, 7, r, 5};
  EXPECT_EQ(convexity_error(solid_of(data)), std::nullopt);
  // the midpoint of the top pushed in or pulled out by one unit in the last place is no longer plane
  MeshData bent = data;
  bent.vertices[m].z = 2 - 0x1p-52;
  EXPECT_EQ(name(Mesh::create(bent).error().code), "not_planar");
}

TEST(Convexity, ADentOfOneUnitInTheLastPlaceIsFound) {
  const Mesh plain = solids::tessellated_cube(2, 2, solids::kDemoSnap);
  for (std::size_t v = 0; v < plain.vertices().size(); ++v) {
    const Point3 p = plain.vertices()[v];
    if (p.z != 1 || p.x != 0 || p.y != 0) continue;
    for (const bool outwards : {false, true}) {
      MeshData data = plain.data();
      data.vertices[v].z = outwards ? 1 + 0x1p-52 : 1 - 0x1p-53;
      const std::optional<Error> error = convexity_error(solid_of(data));
      ASSERT_TRUE(error.has_value());  // outwards: the folds beside the bump are reflex, as the squares' diagonals show
      EXPECT_EQ(name(error->code), "not_convex");
      EXPECT_TRUE(error->evidence.face && error->evidence.other_face && error->evidence.vertex);
    }
  }
}

TEST(Convexity, AReflexEdgeIsNamed) {
  const Mesh mesh = solid_of(l_prism());
  const std::optional<Error> error = convexity_error(mesh);
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(name(error->code), "not_convex");
  EXPECT_EQ(error->evidence.face, 2);
  EXPECT_EQ(error->evidence.other_face, 3);
  EXPECT_EQ(error->evidence.vertex, 6);
  EXPECT_EQ(error->evidence.other_vertex, 7);
  EXPECT_EQ(error->evidence.x, 1);
  EXPECT_EQ(error->evidence.y, 1);
}

TEST(Convexity, NothingAndSeveralShells) {
  EXPECT_EQ(name(convexity_error(Mesh())->code), "no_area");
  const std::optional<Error> error = convexity_error(solid_of(joined(cube(), cube(2, {3, 0, 0}))));
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(name(error->code), "not_convex");
  EXPECT_EQ(error->evidence.face, 6);
}

// Surfaces whose edges are all convex and that wind around themselves are no meshes: a dipyramid over a five-pointed
// star, and one over a limacon, whose small loop lies inside its large one.
TEST(Convexity, surfaces_that_wind_around_themselves_are_refused_before) {
  MeshData star{{{0, 0, -1}, {0, 0, 1}, {0, 4, 0}, {-2, -3, 0}, {4, 1, 0}, {-4, 1, 0}, {2, -3, 0}}, {}};
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t u = 2 + i, v = 2 + (i + 1) % 5;
    star.faces.push_back({u, v, 1});
    star.faces.push_back({v, u, 0});
  }
  EXPECT_EQ(name(Mesh::create(star).error().code), "faces_cross");
  MeshData limacon;
  const double step = std::acos(-1.0) / 12;
  for (int k = 0; k < 24; ++k) {
    const double angle = (k + 0.5) * step, r = 0.5 + std::cos(angle);
    limacon.vertices.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  limacon.vertices.push_back({0.25, 0, -1});
  limacon.vertices.push_back({0.25, 0, 1});
  for (std::uint32_t u = 0; u < 24; ++u) {
    const std::uint32_t v = (u + 1) % 24;
    limacon.faces.push_back({u, v, 25});
    limacon.faces.push_back({v, u, 24});
  }
  EXPECT_EQ(name(Mesh::create(limacon).error().code), "faces_cross");
}

TEST(Convexity, AgreesWithTheHullForRandomDents) {
  int convex = 0, dented = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    MeshData data = solids::geodesic_sphere(1 + static_cast<int>(seed % 3), 1, solids::kDemoSnap).data();
    const double size = std::ldexp(1.0, -static_cast<int>(random() % 6) - 1);
    Point3& p = data.vertices[random() % data.vertices.size()];
    for (double* c : {&p.x, &p.y, &p.z}) *c *= 1 - size * static_cast<double>(random() % 5) / 4;
    const Result<Mesh> mesh = Mesh::create(data);
    if (!mesh) continue;
    const Result<Mesh> hull = convex_hull(mesh->vertices());
    ASSERT_TRUE(hull.ok());
    const bool is_convex = !convexity_error(*mesh).has_value();
    EXPECT_EQ(is_convex, *mesh == *hull) << seed;
    ++(is_convex ? convex : dented);
  }
  EXPECT_GT(convex, 50);
  EXPECT_GT(dented, 50);
}

}  // namespace
}  // namespace dymsum::spatial_test
