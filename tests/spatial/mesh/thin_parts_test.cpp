// Meshes with parts without volume.
#include <gtest/gtest.h>

#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

Error thin_error(const MeshData& data) {
  const Result<Mesh> mesh = Mesh::with_thin_parts(data);
  EXPECT_FALSE(mesh.ok());
  return mesh.ok() ? Error{} : mesh.error();
}

std::size_t thin_count(const Mesh& mesh) {
  return static_cast<std::size_t>(std::count(mesh.thin_faces().begin(), mesh.thin_faces().end(), true));
}

/// A cube with a fin of two squares at its edge from vertex 1 to 3, a segment and a point.
MeshData cube_with_parts() {
  MeshData data = cube();
  data.vertices.insert(data.vertices.end(), {{2, 0, -1}, {2, 1, -1}, {3, 0, -1}, {3, 1, -1}, {9, 9, 9}, {8, 8, 8}});
  data.faces.insert(data.faces.begin(), {{8, 9, 11, 10}, {12}, {1, 3, 9, 8}, {12, 13}});
  return data;
}

TEST(ThinParts, ofASolidAreToldApart) {
  const Mesh mesh = Mesh::with_thin_parts(cube_with_parts()).value();
  EXPECT_EQ(mesh.shell_count(), 1u);
  EXPECT_EQ(thin_count(mesh), 4u);
  for (const std::size_t f : {0, 1, 2, 3}) EXPECT_TRUE(mesh.thin_faces()[f]) << f;
  EXPECT_EQ(volume(mesh), 1);
  EXPECT_EQ(surface_area(mesh), 6 + 1 + std::sqrt(2.0));
  EXPECT_EQ(mesh.edge_count(), 12u + 6 + 1);
  EXPECT_EQ(mesh.triangle_count(), 16u);
  EXPECT_EQ(convexity_error(mesh)->code, ErrorCode::not_convex);
  EXPECT_EQ(convexity_error(mesh)->evidence.face, 0);
  EXPECT_EQ(bounds(mesh), (std::array<double, 6>{0, 0, -1, 9, 9, 9}));
  EXPECT_TRUE(mesh == mesh.canonical());
  EXPECT_TRUE(negated(negated(mesh)) == mesh);
  EXPECT_EQ(thin_count(translated(mesh, 1, 2, 3).value()), 4u);
  EXPECT_EQ(thin_count(scaled(mesh, -1, 2, 1).value()), 4u);
  const TriangulatedMesh split = triangulated(mesh);
  EXPECT_EQ(split.mesh.faces().size(), 16u + 2);
  EXPECT_EQ(thin_count(split.mesh), 4u + 2);
  EXPECT_TRUE(Mesh::with_thin_parts(split.mesh.data()).ok());
  EXPECT_FALSE(Mesh::create(cube_with_parts()).ok());
  EXPECT_EQ(repair(cube_with_parts()).error().code, ErrorCode::not_manifold) << "the fin";
}

TEST(ThinParts, areSurfacesWhereTheyAreNotClosed) {
  MeshData box = cube();
  box.faces.erase(box.faces.begin() + 1);
  const Mesh open = Mesh::with_thin_parts(box).value();
  EXPECT_EQ(open.shell_count(), 0u);
  EXPECT_EQ(thin_count(open), 5u);
  EXPECT_EQ(volume(open), 0);
  EXPECT_EQ(surface_area(open), 5);
  // which way faces run does not matter, nor that they cross
  std::reverse(box.faces[0].begin(), box.faces[0].end());
  box.vertices.insert(box.vertices.end(), {{-1, -1, 0.5}, {2, -1, 0.5}, {0.5, 2, 0.5}});
  box.faces.push_back({8, 9, 10});
  EXPECT_TRUE(Mesh::with_thin_parts(box).ok());
  // a closed surface bounds a solid
  EXPECT_FALSE(Mesh::with_thin_parts(cube())->has_thin_parts());
  EXPECT_TRUE(Mesh::with_thin_parts({}).value().empty());
}

TEST(ThinParts, errors) {
  MeshData data = cube_with_parts();
  data.faces.push_back({4, 5, 7, 6});  // the top once more: no edge of it is free
  const Error twice = thin_error(data);
  EXPECT_EQ(twice.code, ErrorCode::not_manifold);
  EXPECT_EQ(twice.evidence.face, 5);
  data = cube_with_parts();
  data.faces.push_back({});
  EXPECT_EQ(thin_error(data).code, ErrorCode::too_few_vertices);
  data = cube_with_parts();
  data.faces.push_back({12, 12});
  EXPECT_EQ(thin_error(data).code, ErrorCode::repeated_vertex);
  data = cube_with_parts();
  data.vertices[13] = {9, 9, 9};
  EXPECT_EQ(thin_error(data).code, ErrorCode::repeated_vertex);
  data = cube_with_parts();
  data.vertices[11].z = 7;
  EXPECT_EQ(thin_error(data).code, ErrorCode::not_planar);
  data = cube_with_parts();
  data.faces.push_back({1, 12, 77});
  EXPECT_EQ(thin_error(data).code, ErrorCode::bad_index);
  data = cube_with_parts();
  std::reverse(data.faces[5].begin(), data.faces[5].end());
  const Error reversed = thin_error(data);
  EXPECT_EQ(reversed.code, ErrorCode::wrong_orientation);
  EXPECT_GE(reversed.evidence.face.value(), 4) << "by the indices of the data";
}

TEST(ThinParts, bridgesToHolesAreSplitByTheRepair) {
  // A block with a square tunnel, its top and bottom written as one loop each with a bridge.
  MeshData data;
  for (const double z : {0.0, 1.0})
    for (const double h : {3.0, 1.0})
      for (const auto& [x, y] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}}) data.vertices.push_back({x, y, z});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    data.faces.push_back({i, j, 8 + j, 8 + i});
    data.faces.push_back({4 + j, 4 + i, 12 + i, 12 + j});
  }
  data.faces.push_back({8, 9, 10, 11, 8, 12, 15, 14, 13, 12});
  data.faces.push_back({0, 4, 5, 6, 7, 4, 0, 3, 2, 1});
  EXPECT_EQ(Mesh::create(data).error().code, ErrorCode::repeated_vertex);
  const Result<RepairedMesh> repaired = repair(data);
  ASSERT_TRUE(repaired.ok()) << repaired.error().to_string();
  EXPECT_EQ(repaired->report.split_faces, 2u);
  EXPECT_EQ(volume(repaired->mesh), 36 - 4);
  EXPECT_EQ(repaired->mesh.shell_count(), 1u);
}

}  // namespace
}  // namespace dymsum::spatial_test
