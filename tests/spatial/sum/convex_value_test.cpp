// Sums of convex solids are the same value whichever engine made them: set, faces, contacts, exact positions, measures.
#include <gtest/gtest.h>

#include "dymsum/volume_text.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "spatial/convex/convex_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum::test {
namespace {

using Kind = SolidFeature::Kind;

/// One pair of features: where several touch in one plane the general engine names one of them, a convex sum their sum.
bool is_one_pair(const SpatialFace& face) {
  return face.p.kind == Kind::vertex || face.q.kind == Kind::vertex ||
         (face.p.kind == Kind::edge && face.q.kind == Kind::edge);
}

void expect_one_value(const Mesh& p, const Mesh& q, const std::string& what) {
  const SpatialSum convex = *minkowski_sum(p, q), any = *spatial::sum_of_solids(p, q, {});
  ASSERT_TRUE(convex.is_convex()) << what;
  ASSERT_FALSE(any.is_convex()) << what;
  expect_closed(convex);
  ASSERT_EQ(convex, any) << what;
  ASSERT_EQ(convex.shells, any.shells) << what;
  const std::vector<SpatialEdge> edges = convex.edges(), others = any.edges();
  ASSERT_EQ(edges.size(), others.size()) << what;
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    EXPECT_EQ(convex.faces[f].shell, any.faces[f].shell) << what;
    if (!is_one_pair(convex.faces[f])) continue;
    EXPECT_EQ(convex.faces[f].p, any.faces[f].p) << what << ", face " << f;
    EXPECT_EQ(convex.faces[f].q, any.faces[f].q) << what << ", face " << f;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    EXPECT_EQ(edges[e].from, others[e].from) << what;
    EXPECT_EQ(edges[e].to, others[e].to) << what;
    EXPECT_EQ(edges[e].faces, others[e].faces) << what;
    const SolidContact& contact = *edges[e].contact;
    if (contact.p.kind == contact.q.kind || !others[e].contact) continue;  // of parallel edges any part may be named
    EXPECT_EQ(contact, *others[e].contact) << what << ", edge " << e;
  }
  for (std::size_t v = 0; v < convex.vertices.size(); ++v) {
    EXPECT_EQ(convex.exact(v), any.exact(v)) << what << ", vertex " << v;
    EXPECT_EQ(convex.vertices[v].x, convex.exact(v).x.to_double()) << what;
    EXPECT_EQ(convex.vertices[v].y, convex.exact(v).y.to_double()) << what;
    EXPECT_EQ(convex.vertices[v].z, convex.exact(v).z.to_double()) << what;
    if (!any.vertex_contacts[v]) continue;
    EXPECT_EQ(convex.vertex_contacts[v], any.vertex_contacts[v]) << what << ", vertex " << v;
  }
  EXPECT_EQ(convex.volume_exact(), any.volume_exact()) << what;
  EXPECT_EQ(convex.volume(), any.volume()) << what;
  EXPECT_EQ(convex.area(), any.area()) << what;
  EXPECT_EQ(volume_text(convex), volume_text(any)) << what;
  EXPECT_EQ(surface_text(convex), surface_text(any)) << what;
}

TEST(ConvexValue, equals_that_of_the_general_engine_through_parallel_and_coplanar_faces) {
  std::mt19937_64 random(71);
  for (int k = 0; k < oracles::rounds(60, 10); ++k) {
    const Mesh p = random_grid_polytope(random, 4 + k % 9, 3), q = random_grid_polytope(random, 4 + k % 7, 3);
    expect_one_value(p, q, "grid " + std::to_string(k));
    if (k % 6 == 0) expect_one_value(p, negated(p), "difference " + std::to_string(k));
  }
  expect_one_value(cube(1), cube(2), "cubes");
  expect_one_value(solids::cylinder(12, 1, 1, solids::kDemoSnap), solids::cylinder(12, 1, 3, solids::kDemoSnap),
                   "cylinders");
}

TEST(ConvexValue, equals_that_of_the_general_engine_in_all_coordinates) {
  std::mt19937_64 random(72);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int compared = 0;
    for (int k = 0; k < oracles::rounds(8, 2); ++k) {
      const auto of = [&](const Mesh& mesh) { return convex_hull(of_kind(mesh.data(), kind, random).vertices); };
      const Result<Mesh> p = of(random_round_polytope(random, 8 + k)), q = of(random_grid_polytope(random, 8, 3));
      if (!p || !q) continue;
      ++compared;
      expect_one_value(*p, *q, name_of(kind) + std::string(", ") + std::to_string(k));
    }
    EXPECT_GT(compared, 0) << name_of(kind);
  }
}

// Coordinates whose doubles are equal, and which differ in what these leave out.
TEST(ConvexValue, vertices_are_in_the_order_of_exact_positions) {
  const Mesh far = free_box({0x1p60, -1, -1}, {0x1p60 + 0x1p10, 1, 1}),
             small = solids::dipyramid(5, 1, 1, solids::kDemoSnap);
  const SpatialSum sum = *minkowski_sum(far, small);
  std::size_t equal = 0;
  for (std::size_t v = 1; v < sum.vertices.size(); ++v) {
    const RationalPoint3 a = sum.exact(v - 1), b = sum.exact(v);
    EXPECT_LT(std::tie(a.x, a.y, a.z), std::tie(b.x, b.y, b.z));
    equal += sum.vertices[v - 1].x == sum.vertices[v].x && !(a.x == b.x);
  }
  EXPECT_GT(equal, 0u);
  expect_one_value(far, small, "far");
  std::mt19937_64 random(73);
  ConvexSum turned = *ConvexSum::create(cube(1), solids::cylinder(8, 1, 1, solids::kDemoSnap));
  for (int k = 0; k < 8; ++k) {
    turned.set({*Rotation::about({0, 0, 1}, 0.3 * k), {}}, {k % 2 == 0 ? Rotation() : random_rotation(random), {}});
    const SpatialSum posed = turned.sum();
    for (std::size_t v = 1; v < posed.vertices.size(); ++v) {
      const RationalPoint3 a = posed.exact(v - 1), b = posed.exact(v);
      EXPECT_LT(std::tie(a.x, a.y, a.z), std::tie(b.x, b.y, b.z));
    }
  }
}

TEST(ConvexValue, of_several_solids_is_that_of_two_at_a_time_without_rounding) {
  std::mt19937_64 random(74);
  int compared = 0;
  for (int k = 0; k < oracles::rounds(12, 3); ++k) {
    const std::vector<Mesh> solids{random_round_polytope(random, 8), random_grid_polytope(random, 6, 3),
                                   random_grid_polytope(random, 6, 2, 0x1p-40)};
    const SpatialSum sum = *minkowski_sum(solids), first = *minkowski_sum(solids[0], solids[1]);
    EXPECT_TRUE(identical(sum, ConvexSum::create(first, solids[2])->sum())) << k;
    SpatialOptions brute;
    brute.engine = SpatialEngine::brute;
    const Result<SpatialSum> by_facets = minkowski_sum(solids, brute);
    EXPECT_EQ(sum.volume_exact_within(0), sum.volume_exact()) << "binary fractions";
    if (!by_facets) continue;
    EXPECT_EQ(sum, *by_facets) << k;
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace dymsum::test
