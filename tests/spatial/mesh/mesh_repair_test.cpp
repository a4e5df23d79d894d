// The named repair: what it repairs, what it reports, what it leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"
#include "spatial/mesh/open_edges.h"

namespace dymsum::spatial_test {
namespace {

RepairedMesh repaired(MeshData data) {
  Result<RepairedMesh> result = repair(std::move(data));
  EXPECT_TRUE(result.ok()) << result.error().to_string();
  return result.ok() ? std::move(result).value() : RepairedMesh{};
}

/// Every face with vertices of its own.
MeshData soup_of(const MeshData& data) {
  MeshData soup;
  for (const Face& face : data.faces) {
    soup.faces.emplace_back();
    for (const std::uint32_t v : face) {
      soup.faces.back().push_back(static_cast<std::uint32_t>(soup.vertices.size()));
      soup.vertices.push_back(data.vertices[v]);
    }
  }
  return soup;
}

TEST(MeshRepair, LeavesValidMeshesAsTheyAre) {
  for (const MeshData& data : {tetrahedron(), cube(), l_prism(), square_ring(), joined(cube(), cube(2, {3, 0, 0}))}) {
    const RepairedMesh result = repaired(data);
    EXPECT_EQ(result.mesh.data(), data);
    EXPECT_FALSE(result.report.changed());
    EXPECT_EQ(result.report.to_string(), "nothing to repair");
  }
}

TEST(MeshRepair, MergesASoup) {
  const RepairedMesh result = repaired(soup_of(cube()));
  EXPECT_EQ(result.report.duplicate_vertices, 16u);
  EXPECT_EQ(result.mesh, *Mesh::create(cube()));
  EXPECT_EQ(result.report.unused_vertices, 0u);
  EXPECT_EQ(result.report.to_string(), "16 duplicate vertices merged");
}

TEST(MeshRepair, DropsWhatIsNothing) {
  MeshData data = cube();
  data.vertices.push_back({9, 9, 9});
  data.vertices.push_back({0.5, 0, 0});
  data.faces.push_back({0, 9, 1});
  data.faces.push_back({3, 3, 3});
  data.faces.push_back({});
  const RepairedMesh result = repaired(data);
  EXPECT_EQ(result.report.unused_vertices, 2u);
  EXPECT_EQ(result.report.degenerate_faces, 3u);
  EXPECT_EQ(result.mesh.data(), cube());
}

TEST(MeshRepair, SplitsFacesThatAreNotPlane) {
  MeshData data = cube();
  data.vertices[7].z = 1.25;
  EXPECT_EQ(name(Mesh::create(data).error().code), "not_planar");
  const RepairedMesh result = repaired(data);
  EXPECT_EQ(result.report.split_faces, 1u);
  EXPECT_EQ(result.mesh.faces().size(), 7u);
  // a concave face is split inside
  MeshData bent = l_prism();
  bent.vertices[7].z = 1 + 0x1p-40;
  const RepairedMesh concave = repaired(bent);
  EXPECT_EQ(concave.report.split_faces, 1u);  // the walls stay plane
  EXPECT_EQ(concave.mesh.triangle_count(), Mesh::create(l_prism())->triangle_count());
  EXPECT_NEAR(volume(concave.mesh), 3, 1e-9);
}

TEST(MeshRepair, TurnsFacesAndShells) {
  MeshData data = cube();
  std::reverse(data.faces[3].begin() + 1, data.faces[3].end());
  const RepairedMesh one = repaired(data);
  EXPECT_EQ(one.report.reversed_faces, 1u);
  EXPECT_EQ(one.report.reversed_shells, 0u);
  EXPECT_EQ(one.mesh.data(), cube());
  const RepairedMesh shell = repaired(joined(turned_inside_out(cube()), cube(2, {3, 0, 0})));
  EXPECT_EQ(shell.report.reversed_faces, 0u);
  EXPECT_EQ(shell.report.reversed_shells, 1u);
  EXPECT_EQ(shell.mesh.data(), joined(cube(), cube(2, {3, 0, 0})));
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    std::mt19937_64 random(seed);
    const Mesh sphere = solids::geodesic_sphere(3, 1, solids::kDemoSnap);
    MeshData mixed = sphere.data();
    for (Face& face : mixed.faces) {
      if (random() % 3 == 0) std::reverse(face.begin() + 1, face.end());
    }
    EXPECT_EQ(repaired(mixed).mesh.data(), sphere.data()) << seed;
  }
}

TEST(MeshRepair, ErrorsKeepTheNumbersOfTheInput) {
  MeshData data = soup_of(cube());
  data.faces.insert(data.faces.begin(), {0, 0, 0});  // becomes nothing
  data.faces.pop_back();                             // a hole
  const Result<RepairedMesh> holed = repair(data);
  ASSERT_FALSE(holed.ok());
  EXPECT_EQ(name(holed.error().code), "not_closed");
  const auto face = static_cast<std::size_t>(holed.error().evidence.face.value());
  const auto vertex = static_cast<std::uint32_t>(holed.error().evidence.vertex.value());
  ASSERT_LT(face, data.faces.size());
  const Point3 position = data.vertices[vertex];
  EXPECT_EQ(position.x, holed.error().evidence.x);
  bool on_face = false;
  for (const std::uint32_t v : data.faces[face]) on_face |= data.vertices[v] == position;
  EXPECT_TRUE(on_face);

  data = cube();
  data.faces[0][0] = 99;
  EXPECT_EQ(name(repair(data).error().code), "bad_index");
  data = cube();
  data.vertices[3].y = std::nan("");
  EXPECT_EQ(name(repair(data).error().code), "not_finite");
}

/// A cube whose bottom edge from 0 to 1 has a vertex, 8, that its front does not know.
MeshData t_junction(Point3 at = {0.5, 0, 0}) {
  MeshData data = cube();
  data.vertices.push_back(at);
  data.faces[0] = {0, 2, 3, 1, 8};
  return data;
}

TEST(MeshRepair, SplitsTheNeighbourAtATJunction) {
  EXPECT_EQ(name(Mesh::create(t_junction()).error().code), "not_closed");
  const RepairedMesh bare = repaired(t_junction());
  EXPECT_EQ(bare.report.split_edges, 1u);
  EXPECT_EQ(bare.report.largest_gap, 0);
  EXPECT_EQ(bare.report.to_string(), "1 edge split at vertices of its neighbours");
  EXPECT_EQ(bare.mesh, *Mesh::create(cube()));
  // A triangle without area that closes it.
  MeshData needle = t_junction();
  needle.faces.push_back({0, 8, 1});
  const RepairedMesh closed = repaired(needle);
  EXPECT_EQ(closed.report.degenerate_faces, 1u);
  EXPECT_EQ(closed.report.split_edges, 1u);
  EXPECT_EQ(closed.mesh, *Mesh::create(cube()));
  // Both sides of an edge have vertices that the other one does not know.
  MeshData both = t_junction();
  both.vertices.push_back({0.25, 0, 0});
  both.faces[2] = {0, 9, 1, 5, 4};
  EXPECT_EQ(repaired(both).report.split_edges, 2u);
  EXPECT_EQ(repaired(both).mesh, *Mesh::create(cube()));
}

TEST(MeshRepair, SplitsTheNeighbourAtAVertexThatIsNearlyOnItsEdge) {
  const RepairedMesh up = repaired(t_junction({0.5, 0x1p-60, 0})), down = repaired(t_junction({0.5, -0x1p-60, 0}));
  EXPECT_EQ(up.report.split_edges, 1u);
  EXPECT_EQ(up.report.largest_gap, 0x1p-60);
  EXPECT_EQ(down.report.largest_gap, 0x1p-60);
  EXPECT_NEAR(volume(up.mesh), 1, 1e-15);
  // 2^-13 of the edge and no more.
  EXPECT_EQ(repaired(t_junction({0.5, 0x1p-13, 0})).report.largest_gap, 0x1p-13);
  EXPECT_EQ(name(repair(t_junction({0.5, 0x1p-13 + 0x1p-60, 0})).error().code), "not_closed");
  // A triangle that closes it and lies on the bottom is in the way; one inside of it is a valid face, and stays.
  MeshData needle = t_junction({0.5, -0x1p-60, 0});
  needle.faces.push_back({0, 8, 1});
  EXPECT_EQ(name(Mesh::create(needle).error().code), "faces_cross");
  const RepairedMesh without = repaired(needle);
  EXPECT_EQ(without.report.needles, 1u);
  EXPECT_EQ(without.report.split_edges, 1u);
  needle = t_junction({0.5, 0x1p-60, 0});
  needle.faces.push_back({0, 8, 1});
  EXPECT_FALSE(repaired(needle).report.changed());
}

TEST(MeshRepair, TellsOfCavitiesThatItMakes) {
  const MeshData nested = joined(cube(3), cube(1, {1, 1, 1}));
  const RepairedMesh outward = repaired(nested), inward = repaired(turned_inside_out(nested));
  for (const RepairedMesh& one : {outward, inward}) {
    EXPECT_EQ(one.report.cavities, 1u);
    EXPECT_EQ(one.report.reversed_shells, 1u);
    EXPECT_EQ(volume(one.mesh), 26);
    EXPECT_NE(one.report.to_string().find("1 shell that ran the same way as the one around it made a cavity"),
              std::string::npos);
  }
  // One that was a cavity is none that was made, whichever way both ran; nor is a body in it.
  const MeshData hollow = joined(cube(3), turned_inside_out(cube(1, {1, 1, 1})));
  EXPECT_EQ(repaired(hollow).report.cavities, 0u);
  EXPECT_EQ(repaired(turned_inside_out(hollow)).report.cavities, 0u);
  EXPECT_EQ(repaired(turned_inside_out(hollow)).report.reversed_shells, 2u);
  EXPECT_EQ(
      repaired(joined(joined(cube(9), turned_inside_out(cube(7, {1, 1, 1}))), cube(1, {2, 2, 2}))).report.cavities, 0u);
}

/// A box of 2 by 1 by 1 that a wall at x = 1, the last face, parts.
MeshData parted_box() {
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
}

TEST(MeshRepair, DropsWhatPartsTheInside) {
  MeshData data = parted_box();
  EXPECT_EQ(name(Mesh::create(data).error().code), "not_manifold");
  for (int direction = 0; direction < 2; ++direction) {
    const RepairedMesh one = repaired(data);
    EXPECT_EQ(one.report.membranes, 1u);
    EXPECT_EQ(one.mesh, *Mesh::create(solids::box(0, 0, 0, 2, 1, 1).data()));
    const Mesh thin = Mesh::with_thin_parts(data).value();
    EXPECT_EQ(volume(thin), 2);
    EXPECT_TRUE(thin.thin_faces().back());
    EXPECT_EQ(std::count(thin.thin_faces().begin(), thin.thin_faces().end(), true), 1);
    std::reverse(data.faces.back().begin() + 1, data.faces.back().end());
  }
  // Of two triangles, with a vertex of its own.
  data.vertices.push_back({1, 0.5, 0.5});
  data.faces.back() = {8, 10, 12};
  data.faces.insert(data.faces.end(), {{10, 11, 12}, {11, 9, 12}, {9, 8, 12}});
  EXPECT_EQ(repaired(data).report.membranes, 4u);
  EXPECT_EQ(repaired(data).report.unused_vertices, 1u);
  // With a hole in it, it is an open surface.
  data.faces.pop_back();
  EXPECT_EQ(name(repair(data).error().code), "not_manifold");
  EXPECT_EQ(volume(Mesh::with_thin_parts(data).value()), 2);
}

TEST(MeshRepair, KeepsPartsWithoutVolumeWhereAsked) {
  MeshData data = soup_of(cube());
  std::reverse(data.faces[3].begin() + 1, data.faces[3].end());
  const auto first = static_cast<std::uint32_t>(data.vertices.size());
  for (const Point3& p : {Point3{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {6, 0, 0}, {5, 1, 0}, {6, 1, 1}, {9, 9, 9}, {9, 9, 9}})
    data.vertices.push_back(p);
  data.faces.insert(data.faces.end(), {{first, first + 1, first + 2},
                                       {first + 3, first + 4, first + 5},
                                       {first + 6},
                                       {first + 7, first},
                                       {first, first},
                                       {first, first, first + 1}});
  EXPECT_EQ(name(Mesh::with_thin_parts(data).error().code), "repeated_vertex");
  const RepairedMesh one = repair_with_thin_parts(data).value();
  EXPECT_EQ(one.report.reversed_faces, 1u);
  EXPECT_EQ(one.report.degenerate_faces, 1u);
  EXPECT_EQ(one.mesh.shell_count(), 1u);
  EXPECT_EQ(volume(one.mesh), 1);
  EXPECT_EQ(one.mesh.faces().size(), 11u);
  EXPECT_TRUE(repair_with_thin_parts(one.mesh.data()).value().report.to_string() == "nothing to repair");
  // The surface of a box without its lid runs as it ran.
  MeshData open = cube();
  open.faces.pop_back();
  std::reverse(open.faces[1].begin() + 1, open.faces[1].end());
  EXPECT_EQ(repair_with_thin_parts(open)->mesh.data(), open);
  EXPECT_EQ(repair_with_thin_parts(t_junction())->mesh, *Mesh::create(cube()));
}

TEST(MeshRepair, SplitsManyEdgesOfTurnedSolidsThatWereRounded) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const auto angle = [&] { return std::uniform_real_distribution<>(-3, 3)(random); };
    const Mesh sphere = solids::geodesic_sphere(2, 1);
    MeshData data = triangulated(sphere).mesh.data();
    const std::size_t f = random() % data.faces.size();
    const Face old = data.faces[f];  // its neighbours do not know the vertices on its edge
    const Point3 u = data.vertices[old[0]], v = data.vertices[old[1]];
    const auto n = static_cast<std::uint32_t>(data.vertices.size());
    for (const double t : {0.25, 0.5})
      data.vertices.push_back({u.x + t * (v.x - u.x), u.y + t * (v.y - u.y), u.z + t * (v.z - u.z)});
    data.faces[f] = {old[0], n, old[2]};
    data.faces.insert(data.faces.end(), {{n, n + 1, old[2]}, {n + 1, old[1], old[2]}});
    const double a = angle(), b = angle();
    for (Point3& p : data.vertices) {
      p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
      p = {p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)};
      if (seed % 3 == 1) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
      if (seed % 3 == 2) p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6, std::round(p.z * 1e6) / 1e6};
    }
    EXPECT_EQ(name(Mesh::create(data).error().code), "not_closed") << seed;
    const RepairedMesh one = repaired(data);
    EXPECT_EQ(one.report.split_edges, 1u) << seed;
    EXPECT_NEAR(volume(one.mesh), volume(sphere), 1e-5) << seed;
  }
}

TEST(MeshRepair, MoebiusStripsAndOneSidedSurfacesAreRefused) {
  // the real projective plane on six vertices, in space in any position: every edge has two faces, no orientation
  MeshData data{
      {{0, 0, 0}, {1, 0, 2}, {0, 1, 5}, {3, 1, 1}, {2, 4, 1}, {1, 2, 7}},
      {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 5}, {0, 3, 4}, {1, 2, 3}, {1, 2, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}}};
  EXPECT_EQ(name(repair(data).error().code), "wrong_orientation");
}

/// Every triangle with vertices of its own.
MeshData apart(const MeshData& mesh) {
  MeshData soup;
  for (const Face& face : mesh.faces) {
    Face own;
    for (const std::uint32_t v : face) {
      own.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
      soup.vertices.push_back(mesh.vertices[v]);
    }
    soup.faces.push_back(std::move(own));
  }
  return soup;
}

TEST(MeshRepair, vertices_across_a_crack_become_one) {
  MeshData soup = apart(solids::geodesic_sphere(3, 1).data());
  std::mt19937 random(3);
  for (Point3& p : soup.vertices)
    if (random() % 10 == 0) p.x += 1e-9, p.y -= 1e-9 * (random() % 3);
  const RepairedMesh repaired = repair(soup).value();
  EXPECT_GT(repaired.report.cracks, 3u);
  EXPECT_GE(repaired.report.largest_crack, 1e-9);
  EXPECT_LE(repaired.report.largest_crack, 4e-9);
  EXPECT_EQ(repaired.mesh.vertices().size(), solids::geodesic_sphere(3, 1).vertices().size());
  EXPECT_NE(repaired.report.to_string().find("merged across cracks (at most "), std::string::npos);
  // Wider than 2^-20 of the diagonal, some 1.3e-6 here, it stays a crack.
  for (const double wide : {1e-7, 1.2e-6, 1.5e-6, 1e-5}) {
    const std::vector<Point3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, wide}, {0, 1, wide}, {1, 1, 0}};
    std::vector<Face> faces{{0, 1, 2}, {3, 5, 4}};
    EXPECT_EQ(spatial::close_cracks(corners, faces).merged.size(), wide < 1.3e-6 ? 2u : 0u) << wide;
    EXPECT_EQ(faces[1], (wide < 1.3e-6 ? Face{1, 5, 2} : Face{3, 5, 4}));
  }
}

TEST(MeshRepair, a_small_hole_is_filled_and_a_large_one_is_not) {
  MeshData ball = solids::geodesic_sphere(4, 1).data();
  ball.faces.erase(ball.faces.begin() + 7);
  const RepairedMesh repaired = repair(ball).value();
  EXPECT_EQ(repaired.report.holes, 1u);
  EXPECT_EQ(repaired.report.reversed_faces, 0u) << "it runs as those around it do";
  EXPECT_EQ(repaired.mesh.faces().size(), ball.faces.size() + 1);
  EXPECT_NE(repaired.report.to_string().find("1 small hole filled"), std::string::npos);
  MeshData box = solids::box(0, 0, 0, 1, 1, 1).data();
  box.faces.pop_back();
  EXPECT_EQ(repair(box).error().code, ErrorCode::not_closed);
  EXPECT_TRUE(repair_with_thin_parts(box)->mesh.has_thin_parts()) << "an open surface stays one there";
}

}  // namespace
}  // namespace dymsum::spatial_test
