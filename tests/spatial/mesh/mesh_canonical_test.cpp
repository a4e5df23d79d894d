// One solid, one way to write it.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

Mesh mesh_of(MeshData data) {
  Result<Mesh> mesh = Mesh::create(std::move(data));
  EXPECT_TRUE(mesh.ok()) << mesh.error().to_string();
  return mesh.ok() ? std::move(mesh).value() : Mesh{};
}

TEST(MeshCanonical, ATessellatedCubeIsTheCube) {
  for (const int k : {1, 2, 5}) {
    const Mesh tessellated = solids::tessellated_cube(2, k, solids::kDemoSnap);
    EXPECT_EQ(tessellated.canonical().data(), solids::box(-1, -1, -1, 1, 1, 1).canonical().data());
    EXPECT_TRUE(tessellated == solids::box(-1, -1, -1, 1, 1, 1));
    EXPECT_FALSE(tessellated == solids::box(-1, -1, -1, 1, 1, 2));
  }
}

TEST(MeshCanonical, OrderAndTriangulationDoNotMatter) {
  std::uint64_t seed = 0;
  for (const solids::NamedMesh& model : solids::thesis_models()) {
    const Mesh canonical = model.mesh.canonical();
    EXPECT_TRUE(Mesh::create(canonical.data()).ok()) << model.name;
    EXPECT_EQ(canonical.canonical().data(), canonical.data()) << model.name;
    EXPECT_EQ(mesh_of(shuffled(model.mesh.data(), ++seed)).canonical().data(), canonical.data()) << model.name;
    EXPECT_EQ(mesh_of(shuffled(canonical.data(), ++seed)).canonical().data(), canonical.data()) << model.name;
    EXPECT_EQ(volume(canonical), volume(model.mesh)) << model.name;
    EXPECT_EQ(canonical.vertices().size() + canonical.faces().size(), canonical.edge_count() + 2) << model.name;
  }
}

TEST(MeshCanonical, MergedFacesMayBeConcave) {
  // the L as two boxes' surfaces with the common square taken out
  MeshData data = l_prism();
  data.faces.erase(data.faces.end() - 2, data.faces.end());
  // bottom and top as a 2 x 1 and a 1 x 1 rectangle; the vertices are 2 i and 2 i + 1, ring vertex 3 is (1, 1)
  data.vertices.push_back({0, 1, 0});
  data.vertices.push_back({0, 1, 1});
  const std::vector<Face> halves = {{0, 12, 6, 4, 2}, {12, 10, 8, 6}, {1, 3, 5, 7, 13}, {13, 7, 9, 11}};
  data.faces.insert(data.faces.end(), halves.begin(), halves.end());
  ASSERT_EQ(data.faces[5], (Face{10, 0, 1, 11}));
  data.faces[5] = {10, 12, 0, 1, 13, 11};
  EXPECT_EQ(mesh_of(data).canonical().data(), mesh_of(l_prism()).canonical().data());
  EXPECT_EQ(mesh_of(l_prism()).canonical().faces().size(), 8u);
}

TEST(MeshCanonical, AFaceWithAHoleStaysSplit) {
  const Mesh ring = mesh_of(square_ring());
  const Mesh canonical = ring.canonical();
  EXPECT_EQ(canonical.faces().size(), 16u);
  EXPECT_EQ(canonical.canonical().data(), canonical.data());
  EXPECT_EQ(volume(canonical), 8);
}

TEST(MeshCanonical, NegativeZerosDisappear) {
  const Mesh mesh = scaled(mesh_of(cube()), -1, -1, -1)->canonical();
  for (const Point3& p : mesh.vertices()) {
    EXPECT_FALSE((p.x == 0 && std::signbit(p.x)) || (p.y == 0 && std::signbit(p.y)) || (p.z == 0 && std::signbit(p.z)));
  }
}

TEST(MeshCanonical, AMeshOfSeveralShells) {
  const Mesh a = mesh_of(joined(cube(), cube(2, {3, 0, 0}))), b = mesh_of(joined(cube(2, {3, 0, 0}), cube()));
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.canonical().shell_count(), 2u);
}

// A ring cut open whose ends lie against each other: the union of its tops would run along itself, and its ends touch.
TEST(MeshCanonical, ARingWhoseEndsTouchIsNoMesh) {
  MeshData data = prism({{0, 3, 0},
                         {-3, 3, 0},
                         {-3, -3, 0},
                         {3, -3, 0},
                         {3, 3, 0},
                         {0, 2.5, 0},
                         {0, 1.5, 0},
                         {1, 1, 0},
                         {1, -1, 0},
                         {-1, -1, 0},
                         {-1, 1, 0},
                         {0, 1, 0}},
                        1);
  EXPECT_EQ(name(Mesh::create(data).error().code), "self_crossing");
  data.faces.resize(12);
  const std::vector<Face> pieces = {{0, 1, 10, 11}, {1, 2, 9, 10}, {2, 3, 8, 9}, {3, 4, 7, 8}, {4, 5, 6, 7}};
  for (const Face& piece : pieces) {
    Face bottom, top;
    for (const std::uint32_t v : piece) {
      top.push_back(2 * v + 1);
      bottom.insert(bottom.begin(), 2 * v);
    }
    data.faces.push_back(bottom);
    data.faces.push_back(top);
  }
  EXPECT_EQ(name(Mesh::create(data).error().code), "faces_cross");
  // Open by a gap it is one, and its tops are one face.
  for (const std::size_t v : {10u, 11u, 12u, 13u}) data.vertices[v].x = 0.125;
  const Mesh mesh = mesh_of(data), canonical = mesh.canonical();
  EXPECT_EQ(canonical.faces().size(), 14u);
  EXPECT_TRUE(Mesh::create(canonical.data()).ok());
  EXPECT_EQ(volume(canonical), volume(mesh));
  EXPECT_EQ(mesh_of(shuffled(data, 5)).canonical().data(), canonical.data());
}

// Two cubes with faces in one plane, as two shells: nothing is merged across.
TEST(MeshCanonical, ShellsWithFacesInOnePlaneStayApart) {
  const Mesh mesh = mesh_of(joined(cube(), cube(1, {1.25, 0, 0.5})));
  EXPECT_EQ(mesh.canonical().faces().size(), 12u);
  EXPECT_EQ(mesh.shell_count(), 2u);
}

}  // namespace
}  // namespace dymsum::spatial_test
