// Faces that no other solid comes near: what is arranged, what is not, and that the results are those of all faces
// arranged.
#include "spatial/boolean/far_faces.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/boolean/solid_union.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/random_solids.h"

namespace dymsum::spatial {
namespace {

Result<Mesh> moved(const Mesh& mesh, CoordinateKind kind, double x, double y, double z, std::mt19937_64& random) {
  MeshData data = mesh.data();
  for (Point3& p : data.vertices) p.x += x, p.y += y, p.z += z;
  return Mesh::create(of_kind(std::move(data), kind, random));
}

MeshData together(MeshData a, const MeshData& b, bool b_inside_out) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += first;
    if (b_inside_out) std::reverse(face.begin(), face.end());
    a.faces.push_back(std::move(face));
  }
  return a;
}

/// Balls, drums, boxes, a ball with a cavity, two balls that are one solid, and solids at small integers.
Mesh some_solid(std::mt19937_64& random) {
  const int frequency = 1 + static_cast<int>(random() % 4);
  const Mesh ball = solids::geodesic_sphere(frequency, 1, 0x1p-12);
  switch (random() % 7) {
    case 0:
      return solids::cylinder(4 + static_cast<int>(random() % 9), 1, 1, 0x1p-12);
    case 1:
      return solids::box(-1, -1, -0.5, 1, 1, 0.5);
    case 2:
      return solids::tessellated_cube(2, 1 + static_cast<int>(random() % 3));
    case 3:
      return Mesh::create(together(ball.data(), solids::geodesic_sphere(2, 0.5, 0x1p-12).data(), true)).value();
    case 4: {
      MeshData beside = ball.data();
      for (Point3& p : beside.vertices) p.x += 3;
      return Mesh::create(together(ball.data(), beside, false)).value();
    }
    case 5:
      return random_solids::valid_polyhedron(random);
    default:
      return ball;
  }
}

/// All that a result says, exactly.
void expect_same(const SpatialSum& a, const SpatialSum& b, const std::string& name) {
  ASSERT_EQ(a, b) << name;
  ASSERT_EQ(a.shells, b.shells) << name;
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    ASSERT_EQ(a.faces[f].p, b.faces[f].p) << name << ", face " << f;
    ASSERT_EQ(a.faces[f].q, b.faces[f].q) << name << ", face " << f;
    ASSERT_EQ(a.faces[f].shell, b.faces[f].shell) << name << ", face " << f;
  }
}

TEST(FarFaces, results_are_those_of_all_faces_arranged) {
  std::mt19937_64 random(23);
  std::size_t cells = 0, all_cells = 0, faces = 0;
  for (int n = 0; n < 240; ++n) {
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(n) % kCoordinateKinds.size()];
    const auto shift = [&] { return 0.5 * static_cast<double>(random() % 5) - 1; };
    const Result<Mesh> a = moved(some_solid(random), kind, 0, 0, 0, random),
                       b = moved(some_solid(random), kind, shift(), shift(), shift(), random);
    if (!a.ok() || !b.ok()) continue;  // rounding may make faces cross
    const DirectedSolid both[]{{&*a, false}, {&*b, n % 2 == 1}};
    for (const InsideRule rule : {InsideRule{}, InsideRule{2, false, false}, InsideRule{1, true, true}}) {
      SpatialOptions brute;
      brute.engine = SpatialEngine::brute;
      const std::string name = "pair " + std::to_string(n) + ", " + name_of(kind);
      const Result<SpatialSum> fast = solid_inside(both, rule, {}), all = solid_inside(both, rule, brute),
                               surface = solid_inside(together(a->data(), b->data(), n % 2 == 1), rule, {});
      ASSERT_TRUE(fast.ok() && all.ok() && surface.ok()) << name;
      ASSERT_NO_FATAL_FAILURE(expect_same(*fast, *all, name));
      ASSERT_NO_FATAL_FAILURE(expect_same(*fast, *surface, name));
      cells += fast->stats.cells, all_cells += all->stats.cells, faces += fast->faces.size();
    }
  }
  EXPECT_GT(faces, 30000U);
  EXPECT_LT(cells, all_cells / 2) << "most faces are far";
}

TEST(FarFaces, nothing_near_one_cell_for_every_shell) {
  const Mesh ball = solids::geodesic_sphere(4, 1, 0x1p-12);
  std::mt19937_64 random(1);
  const Mesh beside = moved(ball, CoordinateKind::grid, 3, 0, 0, random).value();
  const Mesh inside = solids::geodesic_sphere(3, 0.25, 0x1p-12);
  const Mesh solids[3] = {ball, beside, inside};
  const SpatialSum all = united(solids).value();
  EXPECT_EQ(all.stats.cells, 6U) << "one near face of each ball, and its sheet";
  EXPECT_EQ(all.shells, 2U);
  EXPECT_EQ(all.faces.size(), ball.faces().size() + beside.faces().size());
  EXPECT_EQ(intersection(ball, inside)->faces.size(), inside.faces().size());
  EXPECT_TRUE(intersection(beside, inside)->faces.empty());
  const SpatialSum hollow = difference(ball, inside).value();
  EXPECT_EQ(hollow.shells, 2U);
  EXPECT_EQ(hollow.volume_exact() + intersection(ball, inside)->volume_exact(),
            united(std::span(solids).first(1))->volume_exact());
}

/// What far_faces() says of two solids.
void expect_split(const Mesh& a, const Mesh& b, const std::string& name) {
  const DirectedSolid both[]{{&a, false}, {&b, false}};
  const Surface surface = surface_of(both);
  const std::vector<Triangle>& triangles = surface.operand.triangles;
  const std::vector<Point3>& at = surface.operand.vertices;
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) {
    Box& box = boxes.emplace_back();
    for (const std::uint32_t v : t) box.add(Vec3{at[v].x, at[v].y, at[v].z});
  }
  const SpatialOptions options;
  SpatialStats stats;
  StageWatch watch(options, stats);
  const FarFaces split = far_faces(surface, near_pairs_between(boxes, surface.first_triangle, watch), watch);
  std::vector<bool> near(triangles.size(), false);
  for (const std::uint32_t t : split.near) near[t] = true;
  for (std::uint32_t s = 0; s < triangles.size(); ++s) {
    ASSERT_EQ(near[s], split.sheet[s] == kNoId) << name;
    if (near[s]) continue;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      ASSERT_FALSE((s < surface.first_triangle[1]) != (t < surface.first_triangle[1]) && overlap(boxes[s], boxes[t]))
          << name << ": a far triangle meets a box of the other solid";
    for (std::uint32_t h = 3 * s; h < 3 * s + 3; ++h) {
      const std::uint32_t other = split.twin[h] / 3;
      ASSERT_FALSE(split.flat[h] != 0 && near[other]) << name << ": a face is far as a whole";
      ASSERT_TRUE(near[other] || split.sheet[s] == split.sheet[other]) << name;
    }
  }
  for (const auto& rim : split.rims) ASSERT_FALSE(rim.empty()) << name;
  // The outlines of all far faces use each of their sides once.
  std::vector<std::uint8_t> seen(triangles.size(), 0);
  std::vector<int> used(3 * triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (near[t] || seen[t] != 0) continue;
    for (const auto& loop : outlines(split, t, seen))
      for (const std::uint32_t h : loop) ++used[h];
  }
  for (std::uint32_t h = 0; h < used.size(); ++h)
    ASSERT_EQ(used[h], near[h / 3] || split.flat[h] != 0 ? 0 : 1) << name << ", half-edge " << h;
}

TEST(FarFaces, meet_no_box_of_another_solid) {
  std::mt19937_64 random(5);
  for (int n = 0; n < 60; ++n) {
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(n) % kCoordinateKinds.size()];
    const Result<Mesh> a = moved(some_solid(random), kind, 0, 0, 0, random),
                       b = moved(some_solid(random), kind, 0.5 * static_cast<double>(n % 7), 0.25, 0, random);
    if (a.ok() && b.ok()) expect_split(*a, *b, "pair " + std::to_string(n) + ", " + name_of(kind));
    if (HasFatalFailure()) return;
  }
}

// A vertex inside a straight edge between two faces is none of the result: such faces are arranged.
TEST(FarFaces, outlines_turn_at_every_vertex) {
  // A prism whose upper edges have vertices at their middles.
  MeshData prism;
  const std::array<std::array<double, 2>, 6> base{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}}};
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : base) prism.vertices.push_back({x, y, z});
  prism.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}, {0, 1, 2, 8, 7, 6},
                 {2, 3, 9, 8},       {3, 4, 5, 11, 10, 9}, {5, 0, 6, 11}};
  const Mesh solid = Mesh::create(prism).value();
  const Mesh far = solids::box(5, 5, 5, 6, 6, 6);
  const Mesh both[2] = {solid, far};
  const SpatialSum all = united(both).value();
  EXPECT_EQ(all.vertices.size(), 16U);
  EXPECT_EQ(all.faces.size(), 12U);
}

}  // namespace
}  // namespace dymsum::spatial
