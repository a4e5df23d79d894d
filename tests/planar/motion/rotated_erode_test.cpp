// Inner fits of turned parts: where the turned part is a region itself, the inner fit of that region.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/orientation_sum.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "oracles/vertices_by.h"

namespace dymsum {
namespace {

using oracles::Random;

Region made(const RegionData& data) { return Region::create(data).value(); }

/// R q for R = (3, -4; 4, 3) / 5, of a region whose coordinates are multiples of 5.
RegionData turned_by_345(const RegionData& q) { return oracles::mapped(q, 0.6, -0.8, 0.8, 0.6); }

RegionData times(const RegionData& data, double factor) { return oracles::mapped(data, factor, 0, 0, factor); }

RegionData rounded_coordinates(const RegionData& data) {
  return oracles::vertices_by(data, [](Point p) { return Point{std::round(p.x), std::round(p.y)}; });
}

TEST(RotatedErode, by_a_rational_angle_as_by_the_turned_region) {
  const Orientation theta = Orientation::of(1, 2).value();
  std::size_t fits = 0, tight = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RegionData turned = times(oracles::random_region(random, 3), 5);  // R q of a q that is none of its turns
    // q = R^-1 turned: 5 q is on integers, so everything is scaled by 5 once more.
    const RegionData q = rounded_coordinates(oracles::mapped(times(turned, 5), 0.6, 0.8, -0.8, 0.6));
    const RegionData p = times(oracles::random_parts(random, 8), 25);
    ASSERT_EQ(rounded_coordinates(turned_by_345(q)), times(turned, 5));
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      SumOptions options;
      options.semantics = semantics;
      const PlanarSum expected = erode(made(p), made(times(turned, 5)), options).value();
      const PlanarSum sum = rotated_erode(made(p), made(q), theta, options).value();
      ASSERT_TRUE(sum == expected) << oracles::to_text(p, q, "erode");
      fits += !sum.parts.empty();
      tight += !sum.tight_points.empty() || !sum.tight_segments.empty();
    }
  }
  EXPECT_GT(fits, 100u);
  EXPECT_GT(tight, 20u);
}

// Turned, the bar is longer than the room beside the square would be in a frame for bars that stay as they are.
TEST(RotatedErode, a_long_bar_across_a_square) {
  const Region square = made({{{{{0, 0}, {127, 0}, {127, 127}, {0, 127}}, {}}}, {}, {}});
  const Region bar = made({{{{{0, 0}, {126, 126}, {125, 127}, {-1, 1}}, {}}}, {}, {}});
  const PlanarSum turned = rotated_erode(square, bar, Orientation::of(1, 2).value()).value();
  EXPECT_TRUE(turned.parts.empty() && turned.points.empty() && turned.segments.empty());
  const PlanarSum as_it_is = rotated_erode(square, bar, {}).value();
  EXPECT_EQ(as_it_is, erode(square, bar).value());
  EXPECT_EQ(as_it_is.points.size(), 1u) << "it fits exactly";
}

TEST(RotatedErode, refuses_what_erode_refuses) {
  const Region square = made({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}}, {}, {}}), point = made({{}, {}, {{0, 0}}});
  EXPECT_EQ(rotated_erode(point, square, {}).error(), erode(point, square).error());
  EXPECT_EQ(rotated_erode(square, Region(), {}).error(), erode(square, Region()).error());
  EXPECT_TRUE(rotated_erode(Region(), square, {}).value().parts.empty());
}

}  // namespace
}  // namespace dymsum
