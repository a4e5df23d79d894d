// Moving regions keeps them valid, or says why not.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

Region made_region(RegionData data) { return Region::create(std::move(data)).value(); }

RegionData sample() {
  return {{{box(0, 0, 8, 8), {reversed(box(1, 1, 2, 2)), {{8, 4}, {6, 3}, {6, 5}}}}}, {{{9, 9}, {10, 12}}}, {{-3, 0}}};
}

TEST(RegionTransform, NegatedTwiceIsTheSame) {
  const Region region = made_region(sample());
  const Region once = negated(region);
  EXPECT_TRUE(Region::create(once.data()).ok());
  EXPECT_EQ(once.parts()[0].outer, (Ring{{0, 0}, {-8, 0}, {-8, -8}, {0, -8}}));
  EXPECT_FALSE(std::signbit(once.parts()[0].outer[0].x));
  EXPECT_EQ(once.polylines()[0], (Polyline{{-9, -9}, {-10, -12}}));
  EXPECT_EQ(once.points()[0], (Point{3, 0}));
  EXPECT_EQ(negated(once).data(), region.data());
  EXPECT_EQ(area(once), area(region));
  EXPECT_TRUE(negated(Region()).empty());
}

TEST(RegionTransform, Translated) {
  const Region region = made_region(sample());
  const Region moved = translated(region, 1e9, -3).value();
  EXPECT_EQ(moved.parts()[0].holes[1][0], (Point{1e9 + 8, 1}));
  EXPECT_EQ(translated(moved, -1e9, 3).value(), region);
}

TEST(RegionTransform, TranslationByABigOffsetThatIsNoLatticeVectorKeepsHoles) {
  const Region moved = translated(made_region(sample()), 1e9 + 1.0 / 3, 1e9 + 1.0 / 3).value();
  EXPECT_EQ(moved.hole_count(), 2u);
  EXPECT_EQ(area(moved), area(made_region(sample())));
}

TEST(RegionTransform, TranslationThatRoundsVerticesTogetherIsAnError) {
  const Result<Region> collapsed = translated(made_region(one_ring(box(0, 0, 1, 1))), 1e20, 0);
  ASSERT_FALSE(collapsed.ok());
  EXPECT_EQ(collapsed.error().code, ErrorCode::repeated_vertex);
  const Result<Region> past =
      translated(made_region(one_ring(box(0, 0, 1, 1))), std::numeric_limits<double>::infinity(), 0);
  ASSERT_FALSE(past.ok());
  EXPECT_EQ(past.error().code, ErrorCode::not_finite);
}

TEST(RegionTransform, ScaledByReflectionsStaysValid) {
  const Region region = made_region(sample());
  for (const double sx : {-2.0, 0.5}) {
    for (const double sy : {-4.0, 8.0}) {
      const Result<Region> other = scaled(region, sx, sy);
      ASSERT_TRUE(other.ok()) << other.error().to_string();
      EXPECT_EQ(area(*other), area(region) * std::abs(sx * sy));
      EXPECT_EQ(other->points()[0], (Point{-3 * sx, 0}));
      EXPECT_EQ(scaled(*other, 1 / sx, 1 / sy).value(), region);
    }
  }
  EXPECT_EQ(scaled(region, -1, -1).value(), negated(region));
}

TEST(RegionTransform, ScaleFactorsThatMakeNoSense) {
  const Region region = made_region(sample());
  for (const double bad : {0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(scaled(region, bad, 1).error().code, ErrorCode::unsupported_operand);
    EXPECT_EQ(scaled(region, 1, bad).error().code, ErrorCode::unsupported_operand);
  }
  EXPECT_EQ(scaled(region, 1e308, 1).error().code, ErrorCode::not_finite);
  const Region quarter = made_region(one_ring(box(0, 0, 0.25, 0.25)));
  EXPECT_EQ(scaled(quarter, std::numeric_limits<double>::denorm_min(), 1).error().code, ErrorCode::repeated_vertex);
}

}  // namespace
}  // namespace dymsum::test
