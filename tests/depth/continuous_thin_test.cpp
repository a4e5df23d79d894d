// Continuous depth of points, segments and open surfaces in a solid that moves and turns. The independent answers are
// SolidDepth's search, and thin bars, between whose depth and the segment's there is no more than their thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "dymsum/continuous_depth.h"
#include "dymsum/solids.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

Mesh thin_mesh(std::vector<Point3> vertices, std::vector<Face> faces) {
  return Mesh::with_thin_parts({std::move(vertices), std::move(faces)}).value();
}

/// A point, a segment, a bent line, an open surface, and a solid with a wire.
std::vector<Mesh> thin_parts() {
  MeshData cube = box(1);
  const auto first = static_cast<std::uint32_t>(cube.vertices.size());
  cube.vertices.insert(cube.vertices.end(), {{4, 4, 4}, {5, 4, 6}});
  cube.faces.push_back({first, first + 1});
  return {thin_mesh({{0.25, -0.5, 0.125}}, {{0}}), thin_mesh({{-1, 0, 0}, {1.5, 1, 0.5}}, {{0, 1}}),
          thin_mesh({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}, {{0, 1}, {1, 2}}),
          thin_mesh({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 1}}, {{0, 1, 2}, {0, 2, 3}}),
          Mesh::with_thin_parts(cube).value()};
}

ContinuousDepth without_smoothing(const Mesh& p, const Mesh& q) {
  ContinuousDepthOptions options;
  options.smoothing_length = 0;
  return ContinuousDepth::create(p, q, options).value();
}

/// Its vertices turned by quarter turns about z: (x, y) to (-y, x).
Mesh quarter_turned(const Mesh& mesh, int quarters) {
  MeshData data = mesh.data();
  for (Point3& v : data.vertices)
    for (int k = 0; k < quarters; ++k) v = {-v.y, v.x, v.z};
  return Mesh::with_thin_parts(data).value();
}

Point3 random_position(std::mt19937_64& random) {
  const auto along = [&] { return 0.25 * (static_cast<double>(random() % 33) - 16); };
  return {along(), along(), along()};
}

TEST(ContinuousThin, the_exact_depth_is_that_of_solids_wherever_it_has_moved_and_turned) {
  std::mt19937_64 random(5);
  const std::vector<Mesh> parts = thin_parts();
  int overlapping = 0;
  const int rounds = oracles::rounds(20);
  for (int round = 0; round < rounds; ++round) {
    const Mesh p = round % 4 == 0   ? Mesh::create(ell()).value()
                   : round % 4 == 1 ? Mesh::create(tunnel()).value()
                                    : random_solids::valid_polyhedron(random);
    const Mesh& q = parts[static_cast<std::size_t>(round) % parts.size()];
    ContinuousDepth pair = without_smoothing(p, q), other = without_smoothing(q, p);
    for (int k = 0; k < 6; ++k) {
      const int quarters = k / 2;
      const Rotation turned = Rotation::of(quarters == 0   ? 1
                                           : quarters == 1 ? 1
                                                           : 0,
                                           0, 0, quarters == 0 ? 0 : 1)
                                  .value();
      const Point3 at = random_position(random);
      const SolidDistance exact = SolidDepth::create(p, quarter_turned(q, quarters)).value().at(at);
      const bool inside = exact.meeting == Meeting::overlapping;
      const Result<ContinuousContact> contact = pair.query(at, turned);
      ASSERT_TRUE(contact.ok()) << contact.error().to_string();
      EXPECT_EQ(pair.euclidean_squared(), inside ? exact.squared : Rational(0)) << round << " " << k;
      EXPECT_EQ(pair.euclidean_ways().size(), inside ? exact.ways.size() : 0) << round << " " << k;
      if (inside) {
        EXPECT_NEAR(contact->euclidean_depth, exact.distance, contact->error + 1e-12);
      }
      if (quarters == 0) {
        ASSERT_TRUE(other.query({-at.x, -at.y, -at.z}, {}).ok());
        EXPECT_EQ(other.euclidean_squared(), pair.euclidean_squared()) << round << " " << k;
      }
      overlapping += inside;
    }
  }
  EXPECT_GT(overlapping, rounds / 2);
}

TEST(ContinuousThin, the_smoothed_depth_of_a_segment_is_that_of_a_bar_as_thin_as_one_likes) {
  const Mesh p = solids::box(-4, -3, -2.5, 4, 3, 2.5), segment = thin_mesh({{-1, 0, 0}, {1, 0, 0}}, {{0, 1}});
  constexpr double kThick = 0x1p-12;
  const Mesh bar = solids::box(-1, -kThick, -kThick, 1, kThick, kThick);
  ContinuousDepthOptions options;
  options.smoothing_length = 2;
  ContinuousDepth of_segment = ContinuousDepth::create(p, segment, options).value(),
                  of_bar = ContinuousDepth::create(p, bar, options).value();
  int smoothed = 0;
  for (int k = 0; k <= 40; ++k) {
    const Point3 at{4.75 - 0.05 * k, 0.03 * k, 0.01 * k};
    const Rotation turned = Rotation::about({0, 0, 1}, 0.01 * k).value();
    const ContinuousContact a = of_segment.query(at, turned).value(), b = of_bar.query(at, turned).value();
    EXPECT_NEAR(a.euclidean_depth, b.euclidean_depth, 4 * kThick) << k;
    EXPECT_NEAR(a.depth, b.depth, 16 * kThick) << k;
    EXPECT_GE(a.depth, a.euclidean_depth - a.error) << k;
    EXPECT_LE(a.depth, 2 * a.euclidean_depth + a.error) << k;
    smoothed += a.smoothed;
    if (a.meeting != Meeting::overlapping) continue;
    // Where they touch both hold the witness.
    EXPECT_LE(std::abs(std::abs(a.witness_p.x) - 4) * std::abs(std::abs(a.witness_p.y) - 3) *
                  std::abs(std::abs(a.witness_p.z) - 2.5),
              1e-9)
        << k;
  }
  EXPECT_GT(smoothed, 20);
}

TEST(ContinuousThin, a_sum_is_made_for_an_orientation_and_no_more) {
  const Mesh p = Mesh::create(ell()).value();
  ContinuousDepth pair = ContinuousDepth::create(p, thin_parts()[3]).value();
  EXPECT_GT(pair.smoothing_length(), 0);
  std::mt19937_64 random(6);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(pair.query(random_position(random), {}).value().work.local_sums, k == 0 ? 1U : 0U) << k;
  pair.forget();  // else the turn may be cut into parts
  EXPECT_EQ(pair.query({1, 1, 1}, Rotation::of(3, 1, 0, 1).value()).value().work.local_sums, 1U);
}

}  // namespace
}  // namespace dymsum::test
