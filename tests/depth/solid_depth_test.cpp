// Depth and distance of solids of any shape, against all faces and tight features of their exact sum.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "dymsum/penetration_depth.h"
#include "dymsum/solids.h"
#include "spatial/convex/convex_cases.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

Mesh solid(const MeshData& data) { return Mesh::create(data).value(); }

SolidDepth depth_of(const Mesh& p, const Mesh& q, DepthEngine engine = DepthEngine::search) {
  DepthOptions options;
  options.engine = engine;
  return SolidDepth::create(p, q, options).value();
}

/// Both engines at a translation, which have to agree in everything.
SolidDistance agreed(SolidDepth& search, SolidDepth& boundary, Point3 at) {
  const SolidDistance found = search.at(at), expected = boundary.at(at);
  EXPECT_TRUE(found == expected) << at.x << " " << at.y << " " << at.z << ": " << found.squared.to_string() << " ("
                                 << found.ways.size() << " ways) and " << expected.squared.to_string() << " ("
                                 << expected.ways.size() << ")";
  return found;
}

SolidDistance agreed(const Mesh& p, const Mesh& q, Point3 at = {}) {
  SolidDepth search = depth_of(p, q), boundary = depth_of(p, q, DepthEngine::boundary);
  return agreed(search, boundary, at);
}

TEST(SolidDepth, cubes_that_overlap_by_a_half) {
  const SolidDistance d = agreed(solid(box(1)), solid(box(1)), {1.5, 0, 0});
  EXPECT_EQ(d.meeting, Meeting::overlapping);
  EXPECT_EQ(d.distance, 0.5);
  EXPECT_EQ(d.squared.to_string(), "1/4");
  ASSERT_EQ(d.ways.size(), 1U);
  EXPECT_EQ(d.ways[0].direction, (Point3{1, 0, 0}));
  EXPECT_FALSE(d.ways[0].contacts.empty());
}

TEST(SolidDepth, identical_cubes_have_six_ways_out_and_one_inside_another_too) {
  EXPECT_EQ(agreed(solid(box(1)), solid(box(1))).ways.size(), 6U);
  const SolidDistance inside = agreed(solid(box(2)), solid(box(0.5)));
  EXPECT_EQ(inside.distance, 2.5);
  EXPECT_EQ(inside.ways.size(), 6U);
  EXPECT_EQ(agreed(solid(box(2)), solid(box(0.5)), {0.75, 0, 0}).distance, 1.75);
}

TEST(SolidDepth, touching_and_apart) {
  const SolidDistance touching = agreed(solid(box(1)), solid(box(1)), {2, 0.5, 0});
  EXPECT_EQ(touching.meeting, Meeting::touching);
  EXPECT_EQ(touching.distance, 0);
  ASSERT_EQ(touching.ways.size(), 1U);
  EXPECT_EQ(touching.ways[0].direction, Point3{});
  EXPECT_FALSE(touching.ways[0].contacts.empty());
  const SolidDistance apart = agreed(solid(box(1)), solid(box(1)), {5, 6, 2});
  EXPECT_EQ(apart.meeting, Meeting::apart);
  EXPECT_EQ(apart.distance, 5);
  EXPECT_EQ(agreed(solid(box(1)), solid(box(1)), {0x1p60, 0, 0}).distance, 0x1p60 - 2);
}

TEST(SolidDepth, is_the_same_however_finely_the_surface_is_cut) {
  const Mesh fine = solids::tessellated_cube(2, 1);
  std::optional<SolidDistance> first;
  for (const int k : {1, 2, 4, 8}) {
    SolidDepth pair = depth_of(solids::tessellated_cube(2, k), fine);
    const SolidDistance d = pair.at({1.25, 0.375, 0.125});
    if (!first) first = d;
    EXPECT_EQ(d.squared.to_string(), first->squared.to_string()) << k;
    EXPECT_EQ(d.distance, 0.75);
  }
}

TEST(SolidDepth, a_ball_in_a_tunnel_and_a_box_in_a_cavity) {
  const SolidDistance tight = agreed(solid(tunnel()), solid(box(1)));
  EXPECT_EQ(tight.meeting, Meeting::touching) << "the box fits the tunnel exactly";
  const SolidDistance off = agreed(solid(tunnel()), solid(box(1)), {0, 0.25, 0});
  EXPECT_EQ(off.distance, 0.25) << "back into the tunnel, where there is no clearance";
  EXPECT_EQ(agreed(solid(tunnel()), solid(box(0.5)), {0, 0.75, 0}).distance, 0.25);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(0.5)), {0.25, 0, 0}).meeting, Meeting::apart);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(0.5)), {0.25, 0, 0}).distance, 0.25);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(1)), {0.25, 0, 0}).distance, 0.25) << "a tight point";
  EXPECT_EQ(agreed(solid(cavity()), solid(box(2)), {0, 0, 1}).distance, 6);
  EXPECT_EQ(agreed(solid(ell()), solid(ell()), {1, 1, 0}).meeting, Meeting::overlapping);
}

TEST(SolidDepth, of_random_solids_is_that_of_all_faces_of_the_sum) {
  std::mt19937_64 random(7);
  const int pairs = std::getenv("DYMSUM_FUZZ_PAIRS") ? std::atoi(std::getenv("DYMSUM_FUZZ_PAIRS")) : 25;
  std::uniform_int_distribution<int> quarter(-12, 12);
  int overlapping = 0, ties = 0;
  for (int k = 0; k < pairs; ++k) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    SolidDepth search = depth_of(p, q), boundary = depth_of(p, q, DepthEngine::boundary);
    for (int i = 0; i < 8; ++i) {
      const double unit = i % 2 ? 0.25 : 0.5;
      const SolidDistance d = agreed(search, boundary, {unit * quarter(random), unit * quarter(random), unit * quarter(random)});
      overlapping += d.meeting == Meeting::overlapping;
      ties += d.ways.size() > 1;
      if (HasFailure()) FAIL() << "pair " << k;
    }
  }
  EXPECT_GT(overlapping, pairs);
  EXPECT_GT(ties, 0);
}

}  // namespace
}  // namespace dymsum::test
