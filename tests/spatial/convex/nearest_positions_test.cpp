// Positions of vertices are the doubles nearest to the exact ones, also where pairs of doubles do not decide.
#include <random>

#include "exact/big.h"
#include "spatial/convex/convex_cases.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/convex/setting.h"

namespace dymsum::test {
namespace {

Mesh between(double x0, double x1) {
  std::vector<Point3> at;
  for (const double x : {x0, x1})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) at.push_back({x, y, z});
  return *convex_hull(at);
}

double nearest(const Rational& v) { return exact::round_to_double(exact::exact_value(v)); }

void expect_nearest(const SpatialSum& sum, const std::string& where) {
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    const RationalPoint3 at = sum.exact(v);
    ASSERT_EQ(sum.vertices[v].x, nearest(at.x)) << where;
    ASSERT_EQ(sum.vertices[v].y, nearest(at.y)) << where;
    ASSERT_EQ(sum.vertices[v].z, nearest(at.z)) << where;
    ASSERT_FALSE(std::signbit(sum.vertices[v].x) && sum.vertices[v].x == 0) << where;
  }
}

TEST(NearestPositions, are_the_nearest_doubles_at_any_pose) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 71), moves = setting("DYMSUM_FUZZ_MOVES", 200);
  std::mt19937_64 random(seed);
  for (std::uint64_t k = 0; k < moves; ++k) {
    const Mesh p = k % 2 == 0 ? random_grid_polytope(random, 12, 3) : random_round_polytope(random, 12);
    const Mesh q = k % 3 == 0 ? solids::box(-1, -1, -1, 1, 1, 1) : random_round_polytope(random, 10);
    SolidPose pose{k % 5 == 0 ? Rotation() : random_rotation(random), {}};
    if (k % 4 == 0) pose.scale = {random_scale(random), random_scale(random), random_scale(random)};
    expect_nearest(*convex_sum(p, q, pose, k % 7 == 0 ? pose : SolidPose{}),
                   "seed " + std::to_string(seed) + " " + std::to_string(k));
  }
}

// Sums half-way between two doubles, next to that, beyond the range of pairs, and zero by cancelling.
TEST(NearestPositions, where_pairs_of_doubles_do_not_tell_are_exact) {
  for (const double small : {0x1p-53, 0x1.0000000000001p-53, 0x1.fffffffffffffp-54, 0x1p-300, 0x1p-1074, 0x1p-960}) {
    const Mesh p = between(1, 2), q = between(small, 3 * small);
    expect_nearest(*convex_sum(p, q), std::to_string(small));
    expect_nearest(*convex_sum(p, q, {*Rotation::about({1, 2, 3}, 0.7), {}}), std::to_string(small));
  }
  const Mesh large = between(-0x1p1000, 0x1p1000);
  expect_nearest(*convex_sum(large, large), "large");
}

// Raw coordinates of two solids add up to half-way cases half of the time, along an axis that both keep.
TEST(NearestPositions, half_way_cases_along_a_kept_axis_need_no_exact_numbers) {
  std::mt19937_64 random(72);
  std::uniform_real_distribution<double> coordinate(0.5, 1);
  spatial::ConvexOperands source;
  std::vector<std::uint32_t> all;
  for (std::uint32_t v = 0; v < 51; ++v) {
    all.push_back(v);
    for (spatial::ConvexOperands::Operand& operand : source.operand)
      operand.vertices.push_back({coordinate(random), coordinate(random), coordinate(random)});
  }
  std::vector<spatial::VertexPair> pairs;
  for (const std::uint32_t p : all)
    for (const std::uint32_t q : all) pairs.push_back({p, q});
  std::vector<Point3> at(pairs.size());
  spatial::NearestPositions positions(source, {all, all});
  const SolidPose still, turned{*Rotation::about({0, 0, 1}, 0.7), {}}, quarter{*Rotation::of(1, 1, 1, 1), {}};
  for (const auto& [p, q] : {std::pair{still, still}, {turned, still}, {quarter, still}, {turned, quarter}}) {
    positions.pose(p, q);
    positions.position(pairs, at);
    EXPECT_EQ(positions.decided_exactly(), 0u);
    const spatial::ExactPositions exactly(source, p, q);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const spatial::BigVector a = exactly.of(0, pairs[i].p), b = exactly.of(1, pairs[i].q);
      std::array<double, 3> nearest;
      for (std::size_t k = 0; k < 3; ++k)
        nearest[k] = exact::round_to_double(exact::BigRational(exact::BigInteger(a[k] + b[k])) * exactly.unit());
      ASSERT_EQ(at[i], (Point3{nearest[0], nearest[1], nearest[2]}));
    }
  }
}

}  // namespace
}  // namespace dymsum::test
