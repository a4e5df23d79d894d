// Repairs of solids by name: each is made where it is allowed, and only then; what was repaired is said with positions.
#include <gtest/gtest.h>

#include <algorithm>

#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "spatial/mesh/mesh_repair.h"

namespace dymsum {
namespace {

using Kind = MeshRepairKind;

MeshData together(MeshData a, const MeshData& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += first;
    a.faces.push_back(std::move(face));
  }
  return a;
}
MeshData cube(double at, double size) { return solids::box(at, at, at, at + size, at + size, at + size).data(); }
MeshData triangles(const MeshData& data) { return triangulated(Mesh::create(data).value()).mesh.data(); }

/// A cube with one defect of every kind that its name says.
MeshData defect(Kind kind) {
  MeshData data = cube(0, 1);
  switch (kind) {
    case Kind::duplicate_vertices: {
      MeshData soup;
      for (const Face& face : data.faces) {
        Face own;
        for (const std::uint32_t v : face) {
          own.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
          soup.vertices.push_back(data.vertices[v]);
        }
        soup.faces.push_back(own);
      }
      return soup;
    }
    case Kind::unused_vertices:
      data.vertices.push_back({7, 7, 7});
      return data;
    case Kind::faces_without_area:
      data.faces.push_back({0, 1, 0});
      return data;
    case Kind::duplicate_faces:
      data.faces.push_back({data.faces[3][2], data.faces[3][3], data.faces[3][0], data.faces[3][1]});
      return data;
    case Kind::needles:
    case Kind::t_junctions: {
      data = triangles(data);
      const Face face = data.faces[0];
      const Point3 a = data.vertices[face[0]], b = data.vertices[face[1]];
      const auto middle = static_cast<std::uint32_t>(data.vertices.size());
      data.vertices.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
      data.faces[0] = {face[0], middle, face[2]};
      data.faces.push_back({middle, face[1], face[2]});
      return data;
    }
    case Kind::cracks: {
      data = triangles(data);
      data.vertices.push_back(data.vertices[data.faces[0][0]]);
      data.vertices.back().x += 1e-9;
      data.faces[0][0] = static_cast<std::uint32_t>(data.vertices.size() - 1);
      return data;
    }
    case Kind::holes:
      data = solids::geodesic_sphere(4, 1).data();
      data.faces.pop_back();
      return data;
    case Kind::split_faces:
      data.vertices[0].x -= 0.25;
      data.vertices[0].y -= 0.5;
      data.vertices[0].z -= 0.125;
      return data;
    case Kind::reversed_faces:
      std::reverse(data.faces[2].begin(), data.faces[2].end());
      return data;
    case Kind::reversed_shells:
      for (Face& face : data.faces) std::reverse(face.begin(), face.end());
      return data;
    case Kind::nested_shells:
      return together(cube(0, 4), cube(1, 1));
    case Kind::membranes:  // two halves of a box, and the wall between them
      return {{{0, 0, 0},
               {2, 0, 0},
               {0, 1, 0},
               {2, 1, 0},
               {0, 0, 1},
               {2, 0, 1},
               {0, 1, 1},
               {2, 1, 1},
               {1, 0, 0},
               {1, 1, 0},
               {1, 0, 1},
               {1, 1, 1}},
              {{0, 2, 9, 8},
               {8, 9, 3, 1},
               {4, 10, 11, 6},
               {10, 5, 7, 11},
               {0, 8, 10, 4},
               {8, 1, 5, 10},
               {2, 6, 11, 9},
               {9, 11, 7, 3},
               {0, 4, 6, 2},
               {1, 3, 7, 5},
               {8, 10, 11, 9}}};
    case Kind::loose_walls:
      data.vertices.insert(data.vertices.end(), {{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 1}, {0.5, 0, 1}});
      data.faces.push_back({8, 9, 10});
      data.faces.push_back({8, 10, 11});
      return data;
    case Kind::crossings:
      return together(cube(0, 2), cube(1, 2));
  }
  return data;
}

MeshRepairOptions only(std::vector<Kind> kinds) {
  MeshRepairOptions options;
  options.kinds = std::move(kinds);
  return options;
}

TEST(NamedRepairs, each_is_made_where_it_is_allowed_and_only_then) {
  for (const Kind kind : all_mesh_repairs()) {
    if (kind == Kind::needles) continue;  // below
    const MeshData data = defect(kind);
    EXPECT_FALSE(Mesh::create(data)) << static_cast<int>(kind);
    const Result<LoggedMesh> made = repair_with_union(data, Fill::nonzero, MeshRepairOptions{});
    ASSERT_TRUE(made.ok()) << static_cast<int>(kind) << ": " << made.error().to_string();
    EXPECT_EQ(made->log.kinds(), std::vector<Kind>{kind}) << made->log.to_string();
    EXPECT_TRUE(repair_with_union(data, Fill::nonzero, only({kind}))) << static_cast<int>(kind);
    EXPECT_FALSE(repair_with_union(data, Fill::nonzero, only({}))) << static_cast<int>(kind);
  }
}

TEST(NamedRepairs, positions_are_those_of_the_data) {
  const LoggedMesh walls = repair_with_union(defect(Kind::loose_walls), Fill::nonzero, MeshRepairOptions{}).value();
  EXPECT_EQ(walls.log.loose_walls, 2u);
  EXPECT_EQ(walls.log.to_string(), "2 loose walls inside the solid dropped");
  ASSERT_EQ(walls.log.marks.size(), 2u);
  EXPECT_EQ(walls.log.marks[0], (MeshRepairMark{Kind::loose_walls, {0.5, 0, 0}}));
  EXPECT_EQ(walls.mesh, Mesh::create(cube(0, 1)).value());
  const LoggedMesh unused = repair(defect(Kind::unused_vertices), MeshRepairOptions{}).value();
  EXPECT_EQ(unused.log.marks, (std::vector<MeshRepairMark>{{Kind::unused_vertices, {7, 7, 7}}}));
  const LoggedMesh soup = repair(defect(Kind::duplicate_vertices), MeshRepairOptions{}).value();
  EXPECT_EQ(soup.log.counts.duplicate_vertices, 16u);
  EXPECT_EQ(soup.log.marks.size(), 16u);
}

// Of a whole body that is there twice no face is dropped: these are two bodies that overlap.
TEST(NamedRepairs, faces_given_twice_are_dropped_where_the_others_are_closed_without_them) {
  const LoggedMesh dropped = repair(defect(Kind::duplicate_faces), MeshRepairOptions{}).value();
  EXPECT_EQ(dropped.log.duplicate_faces, 1u);
  EXPECT_EQ(dropped.log.to_string(), "1 face given twice dropped");
  EXPECT_EQ(dropped.mesh, Mesh::create(cube(0, 1)).value());
  const MeshData once = cube(0, 1);
  MeshData twice = once;
  twice.faces.insert(twice.faces.end(), once.faces.begin(), once.faces.end());
  const LoggedMesh united = repair_with_union(twice, Fill::nonzero, MeshRepairOptions{}).value();
  EXPECT_EQ(united.log.duplicate_faces, 0u);
  // A face on a line closes the second copy, between a vertex on an edge and the neighbour that goes past it.
  const Face first = twice.faces.back();
  const auto middle = static_cast<std::uint32_t>(twice.vertices.size());
  const Point3 a = twice.vertices[first[0]], b = twice.vertices[first[1]];
  twice.vertices.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
  twice.faces.back().insert(twice.faces.back().begin() + 1, middle);
  twice.faces.push_back({first[1], middle, first[0]});
  const LoggedMesh closed = repair_with_union(twice, Fill::nonzero, MeshRepairOptions{}).value();
  EXPECT_EQ(closed.log.duplicate_faces, 0u);
  EXPECT_EQ(volume(closed.mesh), 1);
}

TEST(NamedRepairs, a_hole_of_any_size_is_filled_where_its_length_is_given) {
  MeshData open = cube(0, 1);
  open.faces.pop_back();
  EXPECT_EQ(repair(open, MeshRepairOptions{}).error().code, ErrorCode::not_closed);
  MeshRepairOptions options;
  options.hole_length = 3.9;
  EXPECT_FALSE(repair(open, options));
  options.hole_length = 4;
  const LoggedMesh filled = repair(open, options).value();
  EXPECT_EQ(filled.log.longest_hole, 4);
  EXPECT_EQ(volume(filled.mesh), 1);
}

// A wall that reaches out of the solid is a part of the set, and stays an error, as one does that is apart.
TEST(NamedRepairs, walls_that_are_not_in_the_solid_are_refused) {
  MeshData fin = cube(0, 1);
  fin.vertices.insert(fin.vertices.end(), {{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 1.25}});
  fin.faces.push_back({8, 9, 10});
  const Result<LoggedMesh> refused = repair_with_union(fin, Fill::nonzero, MeshRepairOptions{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::not_closed);
  MeshData apart = cube(0, 1);
  apart.vertices.insert(apart.vertices.end(), {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}});
  apart.faces.push_back({8, 9, 10});
  EXPECT_FALSE(repair_with_union(apart, Fill::nonzero, only({Kind::loose_walls})));
}

TEST(NamedRepairs, nested_shells_are_cavities_or_bodies_as_asked) {
  MeshRepairOptions options;
  const LoggedMesh cavity = repair(defect(Kind::nested_shells), options).value();
  EXPECT_EQ(volume(cavity.mesh), 63);
  options.nested = NestedShells::solid;
  const LoggedMesh body = repair(defect(Kind::nested_shells), options).value();
  EXPECT_EQ(volume(body.mesh), 64);
  EXPECT_EQ(body.log.nested_bodies, 1u);
  EXPECT_EQ(body.log.marks, (std::vector<MeshRepairMark>{{Kind::nested_shells, {1, 1, 1}}}));
  EXPECT_EQ(body.mesh, Mesh::create(cube(0, 4)).value());
  // A cavity that runs inward stays one, and a body in it; one in a body that is dropped is dropped with it.
  const auto inward = [](MeshData data) {
    for (Face& face : data.faces) std::reverse(face.begin(), face.end());
    return data;
  };
  const MeshData hollow = together(together(cube(0, 10), inward(cube(1, 8))), cube(3, 2));
  EXPECT_EQ(volume(repair(hollow, options)->mesh), 1000 - 512 + 8);
  const MeshData filled = together(together(cube(0, 10), cube(1, 8)), inward(cube(3, 2)));
  EXPECT_EQ(volume(repair(filled, options)->mesh), 1000);
  // All inside out: the outermost one is turned, and the others with it by what they are inside of.
  EXPECT_EQ(volume(repair(inward(together(cube(0, 4), cube(1, 1))), options)->mesh), 63);
}

TEST(NamedRepairs, cracks_are_as_wide_as_allowed) {
  MeshData data = defect(Kind::cracks);
  data.vertices.back().x += 0.01;
  const auto closed = [&](std::optional<double> width) {
    MeshRepairOptions options = only({Kind::cracks});
    options.crack_width = width;
    return repair(data, options);
  };
  EXPECT_FALSE(closed(std::nullopt));
  EXPECT_FALSE(closed(0.005));
  ASSERT_TRUE(closed(0.02));
  EXPECT_EQ(closed(0.02)->log.counts.cracks, 1u);
  EXPECT_NEAR(volume(closed(0.02)->mesh), 1, 0.01);
}

// One triangle, two that do not share a plane, and one that lies on a face of the solid.
TEST(NamedRepairs, walls_of_any_kind_are_found_to_lie_in_the_solid) {
  const auto walled = [](std::vector<Point3> corners, const std::vector<Face>& faces) {
    MeshData data = cube(0, 4);
    for (Face face : faces) {
      for (std::uint32_t& v : face) v += 8;
      data.faces.push_back(face);
    }
    data.vertices.insert(data.vertices.end(), corners.begin(), corners.end());
    return repair_with_union(data, Fill::nonzero, only({Kind::duplicate_vertices, Kind::loose_walls}));
  };
  EXPECT_TRUE(walled({{1, 1, 1}, {3, 1, 1}, {1, 3, 2}}, {{0, 1, 2}}));
  EXPECT_TRUE(walled({{1, 1, 1}, {3, 1, 1}, {1, 3, 2}, {2, 2, 3}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_TRUE(walled({{1, 1, 0}, {3, 1, 0}, {1, 3, 0}}, {{0, 1, 2}}));
  EXPECT_TRUE(walled({{1, 1, 0}, {3, 1, 0}, {1, 3, 0}, {1, 1, 4}, {3, 1, 4}, {1, 3, 4}}, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(walled({{0, 0, 0}, {4, 4, 0}, {4, 4, 4}, {0, 0, 4}}, {{0, 1, 2, 3}})) << "from edge to edge";
  EXPECT_FALSE(walled({{1, 1, 1}, {3, 1, 1}, {1, 3, 4.0000001}}, {{0, 1, 2}}));
}

TEST(NamedRepairs, the_repairs_of_before_do_not_drop_walls) {
  EXPECT_FALSE(repair_with_union(defect(Kind::loose_walls)));
}

}  // namespace
}  // namespace dymsum
