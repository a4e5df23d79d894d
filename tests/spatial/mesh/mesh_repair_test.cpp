// The named repair: what it mends, what it reports, what it leaves.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"

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
  const Point3 place = data.vertices[vertex];
  EXPECT_EQ(place.x, holed.error().evidence.x);
  bool on_face = false;
  for (const std::uint32_t v : data.faces[face]) on_face |= data.vertices[v] == place;
  EXPECT_TRUE(on_face);

  data = cube();
  data.faces[0][0] = 99;
  EXPECT_EQ(name(repair(data).error().code), "bad_index");
  data = cube();
  data.vertices[3].y = std::nan("");
  EXPECT_EQ(name(repair(data).error().code), "not_finite");
}

TEST(MeshRepair, MoebiusStripsAndOneSidedSurfacesAreRefused) {
  // the real projective plane on six vertices, in space in any position: every edge has two faces, no orientation
  MeshData data{
      {{0, 0, 0}, {1, 0, 2}, {0, 1, 5}, {3, 1, 1}, {2, 4, 1}, {1, 2, 7}},
      {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 5}, {0, 3, 4}, {1, 2, 3}, {1, 2, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}}};
  EXPECT_EQ(name(repair(data).error().code), "wrong_orientation");
}

}  // namespace
}  // namespace dymsum::spatial_test
