// Faces that meet where they may not, against a slow answer; shells inside shells.
#include "spatial/mesh/surface_crossings.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

#include "dymsum/solids.h"
#include "exact/orient.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact3 = std::array<Rational, 3>;

Error refused(const MeshData& data) {
  const Result<Mesh> mesh = Mesh::create(data);
  if (!mesh) return mesh.error();
  ADD_FAILURE() << "accepted";
  return {};
}

MeshData inverted(MeshData data) {
  for (Face& face : data.faces) std::reverse(face.begin(), face.end());
  return data;
}

/// With its six tips one away from the origin.
MeshData octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TEST(SurfaceCrossings, cubes_that_cross_touch_or_stay_apart) {
  for (const auto& [at, crossing] : std::vector<std::pair<Point3, bool>>{
           {{0.5, 0.5, 0.5}, true},    // a corner inside
           {{0.5, 0.25, 0.25}, true},  // and one through a face
           {{1, 0.25, 0.5}, true},     // a face on a face
           {{1, 1, 0.5}, true},        // an edge on an edge
           {{1, 0.5, 1}, true},        // likewise
           {{1.25, 0, 0}, false},
           {{1, 1, 1.25}, false},  // behind a corner
       }) {
    const MeshData data = joined(cube(), cube(1, at));
    if (crossing) {
      EXPECT_EQ(refused(data).code, ErrorCode::faces_cross) << at.x << " " << at.y << " " << at.z;
    } else {
      EXPECT_TRUE(Mesh::create(data)) << at.x << " " << at.y << " " << at.z;
    }
  }
}

TEST(SurfaceCrossings, evidence_names_both_faces_and_the_place) {
  const Error error = refused(joined(cube(2), cube(2, {1, 1, 1})));
  EXPECT_TRUE(error.evidence.face && error.evidence.other_face);
  EXPECT_LT(*error.evidence.face, 6);
  EXPECT_GE(*error.evidence.other_face, 6);
  for (const std::optional<double>& c : {error.evidence.x, error.evidence.y, error.evidence.z}) {
    EXPECT_GE(c, 1);
    EXPECT_LE(c, 2);
  }
}

TEST(SurfaceCrossings, a_vertex_on_a_face_an_edge_through_an_edge) {
  // An octahedron's tip in the middle of a cube's face, from outside.
  MeshData tip = octahedron();
  for (Point3& v : tip.vertices) v.x += 2, v.y += 0.5, v.z += 0.5;
  EXPECT_EQ(refused(joined(cube(), tip)).code, ErrorCode::faces_cross);
  for (Point3& v : tip.vertices) v.x += 0x1p-40;
  EXPECT_TRUE(Mesh::create(joined(cube(), tip)));
  for (Point3& v : tip.vertices) v.x -= 0x1p-39;
  EXPECT_EQ(refused(joined(cube(), tip)).code, ErrorCode::faces_cross);
}

TEST(SurfaceCrossings, a_surface_folded_onto_itself) {
  // The tip of a pyramid bent down through its ground, and two of its faces onto each other.
  EXPECT_EQ(refused({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 0, 2}, {2, 2, -2}},
                     {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}, {0, 4, 5}, {4, 1, 5}}})
                .code,
            ErrorCode::faces_cross);
}

TEST(SurfaceCrossings, generators_make_surfaces_that_do_not) {
  for (const solids::NamedMesh& model : solids::thesis_models()) {
    EXPECT_TRUE(Mesh::create(model.mesh.data())) << model.name;
  }
}

// ---------------------------------------------------------------- against a slow answer

Exact3 exact(const Point3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Exact3 minus(const Exact3& a, const Exact3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Exact3& a, const Exact3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Triangles as convex sets: the part of s inside t's plane or its halves, clipped polygon by polygon.
std::vector<Exact3> clipped(const std::vector<Exact3>& polygon, const Exact3& normal, const Rational& least) {
  std::vector<Exact3> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Rational da = dot(normal, a) - least, db = dot(normal, b) - least;
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const Rational t = da / (da - db);
      const Exact3 d = minus(b, a);
      kept.push_back({a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]});
    }
  }
  return kept;
}

/// The corners of the intersection of two triangles.
std::vector<Exact3> intersection(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t) {
  std::vector<Exact3> polygon{exact(s[0]), exact(s[1]), exact(s[2])};
  const Exact3 a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
  const Exact3 normal = cross(minus(b, a), minus(c, a));
  const auto clip = [&](const Exact3& n, const Exact3& through) { polygon = clipped(polygon, n, dot(n, through)); };
  clip(normal, a);
  clip({-normal[0], -normal[1], -normal[2]}, a);
  clip(cross(normal, minus(b, a)), a);
  clip(cross(normal, minus(c, b)), b);
  clip(cross(normal, minus(a, c)), c);
  return polygon;
}

/// By the definition: a common point that is not in the hull of the common vertices.
bool meet_slowly(const MeshData& data, std::size_t f, std::size_t g) {
  std::array<Point3, 3> s, t;
  std::vector<Exact3> common;
  for (std::size_t k = 0; k < 3; ++k) {
    s[k] = data.vertices[data.faces[f][k]], t[k] = data.vertices[data.faces[g][k]];
    if (std::find(data.faces[g].begin(), data.faces[g].end(), data.faces[f][k]) != data.faces[g].end())
      common.push_back(exact(s[k]));
  }
  for (const Exact3& p : intersection(s, t)) {
    if (common.empty()) return true;
    if (common.size() == 1 && p != common[0]) return true;
    if (common.size() == 2) {
      const Exact3 d = minus(common[1], common[0]), e = minus(p, common[0]);
      if (cross(d, e) != Exact3{}) return true;  // what is on the line and in both triangles is on the common edge
    }
  }
  return false;
}

TEST(SurfaceCrossings, is_what_the_definition_says_on_tiny_grids) {
  constexpr std::uint64_t kSeed = 20261123;
  std::mt19937_64 random(kSeed);
  int crossing = 0, apart = 0;
  for (int round = 0; round < 3000; ++round) {
    // A tetrahedron, and one that shares none, one, two or three of its vertices: closed surfaces when taken apart.
    const auto coordinate = [&] { return static_cast<double>(random() % 4); };
    MeshData data;
    while (data.vertices.size() < 5) {
      const Point3 p{coordinate(), coordinate(), coordinate()};
      if (std::find(data.vertices.begin(), data.vertices.end(), p) == data.vertices.end()) data.vertices.push_back(p);
    }
    const std::uint32_t shared = static_cast<std::uint32_t>(random() % 3);
    data.vertices.push_back({coordinate(), coordinate(), coordinate()});
    if (std::count(data.vertices.begin(), data.vertices.end(), data.vertices[5]) > 1) continue;
    data.faces = {{0, 1, 2}, {3, 4, 5}};
    if (shared > 0) data.faces[1][0] = 0;
    if (shared > 1) data.faces[1] = {1, 0, 4};
    const auto flat = [&](const Face& f) {
      return exact::collinear(data.vertices[f[0]], data.vertices[f[1]], data.vertices[f[2]]);
    };
    if (flat(data.faces[0]) || flat(data.faces[1])) continue;
    const spatial::Triangles triangles = spatial::triangulated(data);
    const bool found =
        spatial::find_meeting(data, triangles, spatial::boxes_of(data.vertices, triangles.triangles)).has_value();
    EXPECT_EQ(found, meet_slowly(data, 0, 1)) << "seed " << kSeed << " round " << round;
    ++(found ? crossing : apart);
  }
  EXPECT_GT(crossing, 300);
  EXPECT_GT(apart, 300);
}

// ---------------------------------------------------------------- shells in shells

TEST(ShellNesting, cavities_run_inward) {
  const MeshData outer = cube(8), hollow = inverted(cube(4, {2, 2, 2})), core = cube(2, {3, 3, 3});
  EXPECT_TRUE(Mesh::create(joined(outer, hollow)));
  EXPECT_TRUE(Mesh::create(joined(joined(outer, hollow), core)));
  EXPECT_EQ(volume(*Mesh::create(joined(joined(outer, hollow), core))), 512 - 64 + 8);
  // Beside a solid nothing runs inward, and inside it nothing outward.
  EXPECT_EQ(refused(joined(outer, inverted(cube(4, {9, 2, 2})))).code, ErrorCode::wrong_orientation);
  const Error solid_in_solid = refused(joined(outer, cube(4, {2, 2, 2})));
  EXPECT_EQ(solid_in_solid.code, ErrorCode::wrong_orientation);
  EXPECT_EQ(solid_in_solid.evidence.face, 6);
  EXPECT_EQ(refused(inverted(outer)).code, ErrorCode::wrong_orientation);
}

TEST(ShellNesting, rays_through_edges_and_vertices_of_other_shells) {
  // All corners at integer heights: every ray from a vertex of the inner ones passes along faces, edges and vertices of
  // the others.
  for (int shift = 0; shift < 3; ++shift) {
    const double s = shift;
    MeshData data = joined(cube(12), inverted(cube(8, {3, 2, 2})));
    data = joined(data, cube(2, {8, 2.0 + s + 0.5, 3 + s}));
    data = joined(data, cube(1, {5, 3 + s, 3 + s}));
    MeshData tip = octahedron();
    for (Point3& v : tip.vertices) v.x += 4.25, v.y += 8.5, v.z += 4 + s;
    EXPECT_TRUE(Mesh::create(joined(data, tip))) << Mesh::create(joined(data, tip)).error().to_string();
  }
}

TEST(ShellNesting, repair_turns_what_runs_the_wrong_way) {
  const MeshData outer = cube(8), inside = cube(4, {2, 2, 2});
  const Result<RepairedMesh> repaired = repair(joined(inverted(outer), inside));
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->report.reversed_shells, 2u);
  EXPECT_EQ(volume(repaired->mesh), 512 - 64);
}

}  // namespace
}  // namespace dymsum::spatial_test
