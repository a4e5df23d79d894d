// What a surface that meets itself is told: crossing, lying on itself, and touching at vertices and edges,
// distinguished.
#include <gtest/gtest.h>

#include <algorithm>

#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

Evidence contact(const MeshData& data, const std::string& message) {
  const Result<Mesh> mesh = Mesh::create(data);
  EXPECT_FALSE(mesh.ok()) << message;
  if (mesh.ok()) return {};
  EXPECT_EQ(mesh.error().code, ErrorCode::faces_cross);
  EXPECT_EQ(mesh.error().message, message);
  return mesh.error().evidence;
}

/// A pyramid with its tip down at the position, over a square of half size 1.
MeshData tip_at(const Point3& p) {
  return {{p,
           {p.x - 1, p.y - 1, p.z + 1},
           {p.x + 1, p.y - 1, p.z + 1},
           {p.x + 1, p.y + 1, p.z + 1},
           {p.x - 1, p.y + 1, p.z + 1}},
          {{1, 2, 3, 4}, {0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}}};
}
/// A wedge whose edge runs along y at the position, from -1 to 1 of it.
MeshData ridge_at(const Point3& p) {
  return {{{p.x, p.y - 1, p.z},
           {p.x, p.y + 1, p.z},
           {p.x - 1, p.y - 1, p.z + 1},
           {p.x + 1, p.y - 1, p.z + 1},
           {p.x + 1, p.y + 1, p.z + 1},
           {p.x - 1, p.y + 1, p.z + 1}},
          {{2, 3, 4, 5}, {0, 3, 2}, {1, 5, 4}, {0, 1, 4, 3}, {1, 0, 2, 5}}};
}

bool is_corner(const MeshData& data, std::int64_t face, std::int64_t vertex) {
  const Face& corners = data.faces[static_cast<std::size_t>(face)];
  return std::find(corners.begin(), corners.end(), static_cast<std::uint32_t>(vertex)) != corners.end();
}

TEST(FaceContact, a_vertex_inside_a_face) {
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, std::pair{1.5, 1.25}}) {  // on a diagonal of the face, and off it
    const MeshData data = joined(cube(2), tip_at({x, y, 2}));
    const Evidence at = contact(data, "a vertex touches this face inside");
    EXPECT_EQ(at.vertex, 8) << "the tip";
    EXPECT_EQ(data.vertices[data.faces[static_cast<std::size_t>(*at.face)][0]].z, 2) << "the cube's top";
    EXPECT_FALSE(is_corner(data, *at.face, 8));
    EXPECT_TRUE(is_corner(data, *at.other_face, 8));
    EXPECT_FALSE(at.other_vertex.has_value());
    EXPECT_EQ((Point3{*at.x, *at.y, *at.z}), (Point3{x, y, 2}));
  }
  const Evidence first = contact(joined(tip_at({1, 1, 2}), cube(2)), "a vertex touches this face inside");
  EXPECT_EQ(first.vertex, 0);
  EXPECT_GE(*first.face, 5) << "in either order";
}

TEST(FaceContact, a_vertex_inside_an_edge) {
  const MeshData data = joined(cube(2), tip_at({2, 1.5, 2}));
  const Evidence at = contact(data, "a vertex touches an edge of this face between its ends");
  EXPECT_EQ(at.vertex, 8);
  ASSERT_TRUE(at.other_vertex.has_value());
  const Face& face = data.faces[static_cast<std::size_t>(*at.face)];
  const auto from = std::find(face.begin(), face.end(), static_cast<std::uint32_t>(*at.other_vertex));
  ASSERT_NE(from, face.end());
  const Point3 a = data.vertices[*from], b = data.vertices[from + 1 == face.end() ? face[0] : from[1]];
  EXPECT_EQ(a.x, 2);
  EXPECT_EQ(b.x, 2);
  EXPECT_EQ(a.z, 2);
  EXPECT_EQ(b.z, 2);
}

TEST(FaceContact, an_edge_on_an_edge) {
  // above the cube's edge along x at y = 0 and z = 2 a ridge along y
  const MeshData data = joined(cube(2), ridge_at({1, 0, 2}));
  const Result<Mesh> mesh = Mesh::create(data);
  ASSERT_FALSE(mesh.ok());
  // half of the ridge lies on the cube's top, so one of its ends touches that
  EXPECT_EQ(mesh.error().message, "a vertex touches this face inside");
  // a ridge that turns away from the top: only the two edges touch
  MeshData leaning = ridge_at({1, 0, 2});
  for (Point3& v : leaning.vertices) v.z += v.y;  // up over the top, down beside it
  const Evidence at = contact(joined(cube(2), leaning), "an edge touches one of another face between the ends of both");
  ASSERT_TRUE(at.vertex && at.other_vertex && at.face && at.other_face);
  EXPECT_NE(*at.vertex < 8, *at.face >= 5 + 6) << "the edge is one of `face`";
  EXPECT_EQ((Point3{*at.x, *at.y, *at.z}), (Point3{1, 0, 2}));
}

TEST(FaceContact, faces_that_cross_and_that_lie_on_each_other) {
  const Evidence crossing = contact(joined(cube(2), cube(2, {1, 1, 1})), "two faces cross");
  EXPECT_FALSE(crossing.vertex.has_value());
  const Evidence lying = contact(joined(cube(2), cube(1, {0.5, 0.5, 2})), "two faces lie on each other");
  EXPECT_EQ(lying.z, 2);
  EXPECT_FALSE(lying.vertex.has_value());
}

}  // namespace
}  // namespace dymsum::spatial_test
