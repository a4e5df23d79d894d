// Every error of Mesh::create, with its evidence.
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

using Number = std::optional<std::int64_t>;

Error error_of(const MeshData& data) {
  const Result<Mesh> mesh = Mesh::create(data);
  if (!mesh) return mesh.error();
  ADD_FAILURE() << "accepted";
  return {};
}

void expect(const Error& error, ErrorCode code, Number face, Number vertex, Number other_face = {},
            Number other_vertex = {}) {
  EXPECT_EQ(name(error.code), name(code)) << error.to_string();
  EXPECT_EQ(error.evidence.face, face) << error.to_string();
  EXPECT_EQ(error.evidence.vertex, vertex) << error.to_string();
  EXPECT_EQ(error.evidence.other_face, other_face) << error.to_string();
  EXPECT_EQ(error.evidence.other_vertex, other_vertex) << error.to_string();
  EXPECT_FALSE(error.message.empty());
}

void expect_position(const Error& error, Point3 at) {
  EXPECT_EQ(error.evidence.x, at.x);
  EXPECT_EQ(error.evidence.y, at.y);
  EXPECT_EQ(error.evidence.z, at.z);
}

TEST(MeshErrors, not_finite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double Point3::*coordinate : {&Point3::x, &Point3::y, &Point3::z}) {
      MeshData data = cube();
      data.vertices[5].*coordinate = bad;
      expect(error_of(data), ErrorCode::not_finite, {}, 5);
    }
  }
}

TEST(MeshErrors, bad_index) {
  MeshData data = cube();
  data.faces[2][1] = 8;
  expect(error_of(data), ErrorCode::bad_index, 2, 8);
  data = cube();
  data.vertices.push_back({7, 8, 9});
  const Error error = error_of(data);
  expect(error, ErrorCode::bad_index, {}, 8);
  expect_position(error, {7, 8, 9});
}

TEST(MeshErrors, too_few_vertices) {
  MeshData data = cube();
  data.faces.push_back({3, 4});
  expect(error_of(data), ErrorCode::too_few_vertices, 6, 3);
  data.faces.back().clear();
  expect(error_of(data), ErrorCode::too_few_vertices, 6, {});
}

TEST(MeshErrors, repeated_vertex) {
  MeshData data = cube();
  data.faces[1] = {4, 5, 7, 5};
  expect(error_of(data), ErrorCode::repeated_vertex, 1, 5);
  data = cube();
  data.vertices[6] = {0, -0.0, 0};
  const Error error = error_of(data);
  expect(error, ErrorCode::repeated_vertex, {}, 0, {}, 6);
  expect_position(error, {0, 0, 0});
}

TEST(MeshErrors, no_area) {
  MeshData data = cube();
  data.vertices.push_back({0.5, 0, 0});
  data.faces.push_back({0, 8, 1});
  const Error line = error_of(data);
  expect(line, ErrorCode::no_area, 6, 0);
  expect_position(line, {0, 0, 0});
  // a sheet with two sides
  const Error sheet = error_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
  expect(sheet, ErrorCode::no_area, 0, 0);
  EXPECT_NE(sheet.message.find("volume"), std::string::npos);
}

TEST(MeshErrors, not_planar_by_one_unit_in_the_last_place) {
  MeshData data = cube();
  data.vertices[7].z = 1 + 0x1p-52;
  const Error error = error_of(data);
  expect(error, ErrorCode::not_planar, 1, 6);
  expect_position(error, {0, 1, 1});
}

TEST(MeshErrors, self_crossing) {
  MeshData data = cube();
  data.faces[1] = {4, 7, 5, 6};
  EXPECT_EQ(name(error_of(data).code), "self_crossing");
  EXPECT_EQ(error_of(data).evidence.face, 1);
  // a face that touches itself in a point, and one that runs along itself
  const std::vector<Point3> touching = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(name(error_of(prism(touching, 1)).code), "self_crossing");
  const std::vector<Point3> spike = {{0, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}};
  EXPECT_EQ(name(error_of(prism(spike, 1)).code), "self_crossing");
}

TEST(MeshErrors, not_closed) {
  MeshData data = cube();
  data.faces.erase(data.faces.begin() + 1);  // the top
  const Error error = error_of(data);
  expect(error, ErrorCode::not_closed, 1, 5, {}, 4);
  expect_position(error, {1, 0, 1});
}

TEST(MeshErrors, not_manifold_where_an_edge_has_three_faces) {
  MeshData data = tetrahedron();
  data.vertices.push_back({-1, 0, 0});
  data.faces.push_back({0, 3, 4});
  data.faces.push_back({3, 0, 4});
  data.faces.push_back({4, 0, 3});
  const Error error = error_of(data);
  expect(error, ErrorCode::not_manifold, 1, 3, 2, 0);
  EXPECT_NE(error.message.find("odd"), std::string::npos);
  expect_position(error, {0, 0, 1});
}

TEST(MeshErrors, not_manifold_where_solids_at_an_edge_overlap) {
  // a tetrahedron, and another one at its edge that reaches into it
  MeshData data = tetrahedron();
  data.vertices.push_back({2, 1, 0});
  data.vertices.push_back({1, 2, 0});
  for (const Face& face : std::vector<Face>{{0, 5, 4}, {0, 4, 3}, {0, 3, 5}, {4, 5, 3}}) data.faces.push_back(face);
  const Error error = error_of(data);
  EXPECT_EQ(name(error.code), "not_manifold");
  EXPECT_TRUE(error.evidence.face && error.evidence.other_face && error.evidence.vertex && error.evidence.other_vertex);
}

TEST(MeshErrors, wrong_orientation) {
  MeshData data = cube();
  std::reverse(data.faces[3].begin(), data.faces[3].end());
  const Error edge = error_of(data);
  expect(edge, ErrorCode::wrong_orientation, 0, 2, 3, 3);
  const Error inside_out = error_of(joined(cube(), turned_inside_out(cube(1, {5, 0, 0}))));
  expect(inside_out, ErrorCode::wrong_orientation, 6, 8);
  expect_position(inside_out, {5, 0, 0});
}

}  // namespace
}  // namespace dymsum::spatial_test
