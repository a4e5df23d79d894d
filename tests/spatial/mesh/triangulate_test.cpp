// Triangulations use all vertices, have only triangles with area, and cover the face.
#include "spatial/mesh/triangulate.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include <map>

#include "dymsum/shapes.h"
#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

/// The mesh with its faces split is valid and the same solid. (Faces around a hole are not merged again.)
void expect_splits(const MeshData& data, bool merges = true) {
  const Result<Mesh> whole = Mesh::create(data);
  ASSERT_TRUE(whole.ok()) << whole.error().to_string();
  const spatial::Triangles split = spatial::triangulated(data);
  MeshData triangles{data.vertices, {}};
  for (const spatial::Triangle& t : split.triangles) triangles.faces.emplace_back(t.begin(), t.end());
  EXPECT_EQ(split.triangles.size(), whole->triangle_count());
  EXPECT_EQ(split.face.size(), split.triangles.size());
  const Result<Mesh> mesh = Mesh::create(triangles);
  ASSERT_TRUE(mesh.ok()) << mesh.error().to_string();
  EXPECT_EQ(volume(*mesh), volume(*whole));
  EXPECT_EQ(*mesh == *whole, merges);
}

std::vector<Point3> lifted(const Ring& ring) {
  std::vector<Point3> points;
  for (const Point p : ring) points.push_back({p.x, p.y, 0});
  return points;
}

TEST(Triangulate, PrismsOverShapes) {
  expect_splits(cube());
  expect_splits(l_prism());
  expect_splits(square_ring(), false);
  for (const Region& shape :
       {snapped_shapes::gear(9, 1, 2), snapped_shapes::star(7, 1, 3), snapped_shapes::spiral(2, 12, 2, 1),
        shapes::comb(5, 2, 1, 4), snapped_shapes::disc(40, 1)}) {
    expect_splits(prism(lifted(shape.parts()[0].outer), 1));
  }
}

TEST(Triangulate, VerticesInTheMiddleOfEdges) {
  expect_splits(prism({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}, 1));
  expect_splits(prism({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 2, 0}, {1, 1, 0}}, 1));
  expect_splits(prism({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, 1));
  // the diagonals of this one pass through its vertices
  expect_splits(prism({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}, {2, 2, 0}, {1, 1, 0}, {0, 4, 0}}, 1));
}

TEST(Triangulate, EveryViewOfATurnedFace) {
  for (const auto& turn : {+[](Point3 p) {
                             return Point3{p.y, p.z, p.x};
                           },
                           +[](Point3 p) {
                             return Point3{p.z, p.x, p.y};
                           },
                           +[](Point3 p) {
                             return Point3{p.x - p.y, p.x + p.y, p.z + p.x};
                           }}) {
    MeshData data = l_prism();
    for (Point3& p : data.vertices) p = turn(p);
    expect_splits(data);
  }
}

TEST(Triangulate, PolygonsThatCrossThemselvesKeepTheirEdges) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Point3> points;
    Face face;
    for (std::uint32_t i = 0; i < 3 + random() % 9; ++i) {
      points.push_back({double(random() % 4), double(random() % 4), double(random() % 2)});
      face.push_back(i);
    }
    const auto triangles = spatial::triangulated(points, face, spatial::average_view(points, face));
    EXPECT_EQ(triangles.size(), face.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        ++sides[{t[k], t[(k + 1) % 3]}];
        --sides[{t[(k + 1) % 3], t[k]}];
      }
    }
    for (const auto& [ends, count] : sides) {
      const bool of_face = (ends.first + 1) % face.size() == ends.second;
      const bool reversed = (ends.second + 1) % face.size() == ends.first;
      EXPECT_EQ(count, of_face ? 1 : reversed ? -1 : 0);
    }
  }
}

}  // namespace
}  // namespace dymsum::spatial_test
