// The named repair of surfaces that cross, touch or overlap: the mesh is valid, and the solid the one meant.
#include <gtest/gtest.h>

#include <iostream>

#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/verdict.h"
#include "spatial/boolean/winding_oracle.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

MeshData with(MeshData a, const MeshData& b, bool inside_out = false) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += first;
    if (inside_out) std::reverse(face.begin(), face.end());
    a.faces.push_back(std::move(face));
  }
  return a;
}

MeshData cube(double x, double y, double z, double size = 1) {
  return solids::box(x, y, z, x + size, y + size, z + size).data();
}

TEST(RepairWithUnion, what_is_valid_or_mended_otherwise_stays_so) {
  const RepairedMesh whole = repair_with_union(cube(0, 0, 0)).value();
  EXPECT_FALSE(whole.report.changed());
  EXPECT_EQ(whole.mesh.vertices().size(), 8u);
  MeshData turned = cube(0, 0, 0);
  std::reverse(turned.faces[0].begin(), turned.faces[0].end());
  const RepairedMesh repaired = repair_with_union(turned).value();
  EXPECT_FALSE(repaired.report.united);
  EXPECT_EQ(repaired.report.reversed_faces, 1u);
}

TEST(RepairWithUnion, bodies_that_overlap_or_share_faces_are_one) {
  const RepairedMesh overlap = repair_with_union(with(cube(0, 0, 0, 2), cube(1, 1, 1, 2))).value();
  EXPECT_TRUE(overlap.report.united);
  EXPECT_EQ(overlap.report.united_crossings, 6u);
  EXPECT_EQ(overlap.report.united_distance, 0);
  EXPECT_EQ(volume(overlap.mesh), 15);
  EXPECT_EQ(overlap.report.to_string(), "what crossed or overlapped united (6 new vertices)");
  const RepairedMesh shared = repair_with_union(with(cube(0, 0, 0), cube(1, 0, 0))).value();
  EXPECT_EQ(volume(shared.mesh), 2);
  EXPECT_EQ(shared.mesh.canonical().faces().size(), 6u);
  const RepairedMesh half = repair_with_union(with(cube(0, 0, 0), cube(1, 0.5, 0.25))).value();
  EXPECT_EQ(volume(half.mesh), 2);
  EXPECT_EQ(half.mesh.shell_count(), 1u);
  const RepairedMesh inside_out = repair_with_union(with(cube(0, 0, 0, 2), cube(1.5, 0.5, 0.5), true)).value();
  EXPECT_EQ(volume(inside_out.mesh), 8.5) << "what crosses is a body, whichever way it runs";
  EXPECT_EQ(inside_out.report.reversed_shells, 1u);
  MeshData three = with(with(cube(0, 0, 0, 4), cube(3, 3, 3, 2)), cube(1, 1, 1), true);
  EXPECT_EQ(volume(repair_with_union(three)->mesh), 64 + 7 - 1) << "what crosses nothing is a cavity";
}

TEST(RepairWithUnion, errors_are_those_of_repair) {
  MeshData open = with(cube(0, 0, 0, 2), cube(1, 1, 1, 2));
  open.faces.pop_back();
  EXPECT_EQ(repair_with_union(open).error(), repair(open).error());
  open.vertices[3].x = INFINITY;
  EXPECT_EQ(repair_with_union(open).error().code, ErrorCode::not_finite);
  SpatialOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(repair_with_union(with(cube(0, 0, 0, 2), cube(1, 1, 1, 2)), Fill::nonzero, options).error().code,
            ErrorCode::cancelled);
}

// Surfaces that cross themselves, with coordinates of every kind, against rational winding numbers at positions that
// are not near any face. DYMSUM_FUZZ_REPAIRS pairs of solids, three positions each.
TEST(RepairWithUnion, meshes_are_valid_and_hold_what_the_surfaces_go_around) {
  std::mt19937_64 random(40502);
  int united = 0, merged = 0, compared = 0;
  const int all = static_cast<int>(oracles::setting("DYMSUM_FUZZ_REPAIRS", 60));
  for (int n = 0; n < all; ++n) {
    MeshData surface;
    for (int k = 0; k < 2; ++k) {
      MeshData m = random_solids::tiny_polyhedron(random);
      for (Point3& p : m.vertices) p.x += static_cast<double>(random() % 3);
      surface = with(std::move(surface), m);
    }
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(n) % kCoordinateKinds.size()];
    surface = of_kind(std::move(surface), kind, random);
    MeshRepairOptions repairs;  // without those that turn bodies over
    std::erase(repairs.kinds, MeshRepairKind::reversed_shells);
    const Result<LoggedMesh> repaired = repair_with_union(surface, Fill::nonzero, repairs);
    ASSERT_TRUE(repaired.ok()) << n << ", " << name_of(kind) << ": " << repaired.error().to_string();
    EXPECT_TRUE(Mesh::create(repaired->mesh.data()).ok());
    EXPECT_TRUE(repair_with_union(surface).ok()) << n << ", " << name_of(kind);
    if (!repaired->log.counts.united) continue;
    ++united, merged += repaired->log.counts.united_distance > 0;
    const oracles::ExactSurface before = oracles::exact_surface(surface),
                                after = oracles::exact_surface(repaired->mesh.data());
    for (int k = 0; k < 3; ++k) {
      const Point3& corner = surface.vertices[random() % surface.vertices.size()];
      const auto near = [&](double c) {
        return oracles::exact_of(c) +
               Rational::of(static_cast<std::int64_t>(random() % 199999) - 99999, 100003).value();
      };
      const oracles::RationalVector at{near(corner.x), near(corner.y), near(corner.z)};
      const std::optional<int> is = oracles::winding_at(after, at), was = oracles::winding_at(before, at);
      if (!is || !was) continue;
      EXPECT_EQ(*is, *was != 0) << n << ", " << name_of(kind);
      ++compared;
    }
  }
  EXPECT_GT(united, all * 2 / 3);
  EXPECT_GT(merged, 2);
  EXPECT_GT(compared, all * 2);
  std::cout << compared << " positions compared\n";
}

}  // namespace
}  // namespace dymsum
