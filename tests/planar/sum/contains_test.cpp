// Membership of one point in a sum, against membership by definition.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/pair_text.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"

namespace dymsum {
namespace {

using oracles::Big;
using oracles::from_double;

constexpr std::uint64_t kSeed = 161803;

TEST(Contains, equals_membership_by_definition_on_tiny_grids) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  int boundary = 0, inside = 0, outside = 0;
  for (int k = 0; k < 300; ++k) {
    oracles::Random random(kSeed + static_cast<std::uint64_t>(k));
    const auto [dp, dq] = oracles::random_pair(random, 2 + random.below(5));
    const Region p = Region::create(dp).value(), q = Region::create(dq).value();
    const oracles::Membership<Big> member(dp, dq);
    const auto a = bounds(p), b = bounds(q);
    for (int i = 0; i < 12; ++i) {
      // Grid places are where sets touch; halves lie between.
      const double step = i % 3 == 0 ? 0.5 : 1;
      const auto pick = [&](double low, double high) {
        return low - 1 + step * random.below(static_cast<int>((high - low + 2) / step) + 1);
      };
      const Point z{pick(a[0] + b[0], a[2] + b[2]), pick(a[1] + b[1], a[3] + b[3])};
      const oracles::Pt<Big> exact{from_double<Big>(z.x), from_double<Big>(z.y)};
      const bool meets = member.meets(exact), overlaps = member.overlaps(exact);
      ASSERT_EQ(contains(p, q, z, Semantics::closed), meets) << z.x << " " << z.y << "\n" << oracles::to_text(dp, dq);
      ASSERT_EQ(contains(p, q, z, Semantics::open), overlaps) << z.x << " " << z.y << "\n" << oracles::to_text(dp, dq);
      const bool with_area = member.meets_with_area(exact), regular = contains(p, q, z, Semantics::regular);
      ASSERT_TRUE(!with_area || regular) << z.x << " " << z.y << "\n" << oracles::to_text(dp, dq);
      ASSERT_TRUE(meets || !regular) << z.x << " " << z.y << "\n" << oracles::to_text(dp, dq);
      boundary += meets && !overlaps;
      inside += overlaps;
      outside += !meets;
    }
  }
  EXPECT_GT(boundary, 300);
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 300);
}

Region segment(Point a, Point b) { return Region::create({{}, {{a, b}}, {}}).value(); }
Region point(Point a) { return Region::create({{}, {}, {a}}).value(); }

TEST(Contains, an_exact_fit_is_closed_but_not_open) {
  const Region plate =
      Region::create({{{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 3}, {3, 5}, {5, 5}, {5, 3}}}}}, {}, {}}).value();
  const Region square = shapes::rectangle(-1, -1, 1, 1);
  EXPECT_TRUE(contains(plate, square, {4, 4}, Semantics::closed));
  EXPECT_FALSE(contains(plate, square, {4, 4}, Semantics::open));
  EXPECT_TRUE(contains(plate, square, {std::nextafter(4.0, 5.0), 4}, Semantics::open));
  EXPECT_TRUE(contains(plate, square, {4, std::nextafter(4.0, 3.0)}, Semantics::open));
}

TEST(Contains, one_set_inside_the_other_without_touching) {
  const Region big = shapes::rectangle(0, 0, 100, 100), small = snapped_shapes::disc(12, 1);
  for (const Semantics s : {Semantics::closed, Semantics::open, Semantics::regular}) {
    EXPECT_TRUE(contains(big, small, {50, 50}, s));
    EXPECT_TRUE(contains(small, big, {50, 50}, s));
    EXPECT_TRUE(contains(big, point({1, 2}), {50, 50}, s));
    EXPECT_TRUE(contains(big, segment({1, 2}, {3, 1}), {50, 50}, s));
    EXPECT_FALSE(contains(big, small, {102, 50}, s));
  }
}

TEST(Contains, thin_pairs) {
  const Region a = segment({0, 0}, {2, 0}), b = segment({0, 0}, {0, 2}), c = segment({0, 0}, {4, 0});
  for (const Point z : {Point{1, 1}, Point{0, 0}, Point{2, 1}}) {
    EXPECT_TRUE(contains(a, b, z, Semantics::closed));
    EXPECT_TRUE(contains(a, b, z, Semantics::regular));  // the parallelogram
    EXPECT_FALSE(contains(a, b, z, Semantics::open));
  }
  EXPECT_TRUE(contains(a, c, {6, 0}, Semantics::closed));
  EXPECT_FALSE(contains(a, c, {6, 0}, Semantics::regular));  // a segment has no interior
  EXPECT_FALSE(contains(a, c, {6.5, 0}, Semantics::closed));
  EXPECT_FALSE(contains(a, c, {1, 0}, Semantics::open));
  EXPECT_TRUE(contains(a, point({1, 1}), {3, 1}, Semantics::closed));
  EXPECT_FALSE(contains(a, point({1, 1}), {3, 1}, Semantics::regular));
  EXPECT_FALSE(contains(a, point({1, 1}), {3, 2}, Semantics::closed));
}

TEST(Contains, points) {
  EXPECT_TRUE(contains(point({1, 2}), point({3, 4}), {4, 6}));
  EXPECT_FALSE(contains(point({1, 2}), point({3, 4}), {4, 7}));
  EXPECT_TRUE(contains(point({1, 2}), point({0, 0}), {1, 2}));  // z and 0 are the only positions there are
  EXPECT_FALSE(contains(point({1, 2}), point({0, 0}), {1, 2}, Semantics::open));
  EXPECT_FALSE(contains(point({1, 2}), point({0, 0}), {1, 2}, Semantics::regular));
  EXPECT_TRUE(contains(point({0, 0}), point({0, 0}), {0, 0}));
}

TEST(Contains, nothing_in_an_empty_sum_or_at_no_place) {
  const Region square = shapes::rectangle(0, 0, 1, 1), none;
  EXPECT_FALSE(contains(square, none, {0, 0}));
  EXPECT_FALSE(contains(none, square, {0, 0}));
  EXPECT_FALSE(contains(square, square, {std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(contains(square, square, {0, std::numeric_limits<double>::infinity()}));
}

// The sum of 0.1 and 0.2 is not a double: both neighbours must be distinguished from it, and far translations change
// nothing.
TEST(Contains, decides_what_doubles_cannot_hold) {
  const Region p = shapes::rectangle(0, 0, 0.1, 1), q = shapes::rectangle(0, 0, 0.2, 1);
  EXPECT_FALSE(contains(p, q, {0.1 + 0.2, 1}));  // rounded up
  EXPECT_TRUE(contains(p, q, {std::nextafter(0.1 + 0.2, 0), 1}));
  EXPECT_TRUE(contains(p, q, {std::nextafter(0.1 + 0.2, 0), 0.5}, Semantics::open));
  const Region far = shapes::rectangle(0x1p60, 0, 0x1p60 + 0x1p10, 1),
               back = shapes::rectangle(-0x1p60, 0, -0x1p60 + 0x1p10, 1);
  EXPECT_TRUE(contains(far, back, {0, 1}));
  EXPECT_FALSE(contains(far, back, {-0x1p-1000, 1}));
  EXPECT_TRUE(contains(far, back, {0x1p-1000, 1}));
}

}  // namespace
}  // namespace dymsum
