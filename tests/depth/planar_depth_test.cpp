// Depth and distance of planar regions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "dymsum/penetration_depth.h"

namespace dymsum::test {
namespace {

Region region(std::vector<Part> parts) { return Region::create({std::move(parts), {}, {}}).value(); }

Region square(double half) { return region({{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {}}}); }

/// A square of half size 3 with a hole of half size 1.
Region frame() { return region({{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}}}); }

TEST(PlanarDepth, of_squares_and_a_frame) {
  const PlanarDepth squares = PlanarDepth::create(square(1), square(1)).value();
  EXPECT_EQ(squares.at({1.5, 0}).distance, 0.5);
  EXPECT_EQ(squares.at({1.5, 0}).ways.at(0).direction, (Point{1, 0}));
  EXPECT_EQ(squares.at({0, 0}).ways.size(), 4U);
  EXPECT_EQ(squares.at({2, 1}).meeting, Meeting::touching);
  EXPECT_EQ(squares.at({5, 6}).distance, 5);
  EXPECT_EQ(squares.at({5, 6}).meeting, Meeting::apart);
  const PlanarDepth loose = PlanarDepth::create(frame(), square(0.5)).value();
  EXPECT_EQ(loose.at({0, 0}).meeting, Meeting::apart);
  EXPECT_EQ(loose.at({0, 0}).distance, 0.5);
  EXPECT_EQ(loose.at({0.75, 0.25}).distance, 0.25);
  const PlanarDepth tight = PlanarDepth::create(frame(), square(1)).value();
  EXPECT_EQ(tight.at({0, 0}).meeting, Meeting::touching);
  EXPECT_EQ(tight.at({0.25, 0.25}).squared.to_string(), "1/8") << "back into a hole that fits exactly";
  EXPECT_FALSE(tight.at({0.25, 0.25}).ways.at(0).contacts.empty());
}

TEST(PlanarDepth, the_way_out_separates_and_no_shorter_one_does) {
  const Region p = frame(), q = region({{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}});
  const PlanarDepth depth = PlanarDepth::create(p, q).value();
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> eighth(-40, 40);
  int overlapping = 0;
  for (int k = 0; k < 60; ++k) {
    const Point at{eighth(random) / 8.0, eighth(random) / 8.0};
    const PlanarDistance d = depth.at(at);
    if (d.meeting != Meeting::overlapping) continue;
    ++overlapping;
    for (const PlanarWay& way : d.ways) {
      const Point to{at.x + way.move.x.to_double(), at.y + way.move.y.to_double()};
      EXPECT_FALSE(contains(p, negated(q), to, Semantics::open)) << k;  // multiples of an eighth
    }
    for (int a = 0; a < 32; ++a) {
      const double r = 0.999 * d.distance;
      const Point to{at.x + r * std::cos(a * 0.2), at.y + r * std::sin(a * 0.2)};
      EXPECT_TRUE(contains(p, negated(q), to, Semantics::open)) << k;
    }
  }
  EXPECT_GT(overlapping, 10);
}

// Squares of lengths below 2^-537 underflow, above 2^512 they overflow: both once chose edges that are not the nearest.
TEST(PlanarDepth, shapes_of_any_size_have_the_same_depth_but_for_their_size) {
  for (const int k : {-1070, -1000, -830, -700, -545, -540, -537, -500, 0, 500, 510, 900, 990}) {
    const double s = std::ldexp(1.0, k);
    const auto scaled = [&](Ring ring) {
      for (Point& at : ring) at = {s * at.x, s * at.y};
      return region({{ring, {}}});
    };
    const Region slot = scaled({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}});
    const Region peg = scaled({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
    const PlanarDistance d = PlanarDepth::create(slot, peg).value().at({0, 0});
    const Rational unit = Rational::of(s).value();
    EXPECT_EQ(d.squared, unit * unit) << "2^" << k;
    EXPECT_EQ(d.distance, s) << "2^" << k;
    ASSERT_EQ(d.ways.size(), 1U) << "2^" << k;
    EXPECT_EQ(d.ways[0].direction, (Point{0, -1}));
  }
}

TEST(PlanarDepth, what_has_no_area_is_refused) {
  EXPECT_EQ(PlanarDepth::create(square(1), Region()).error().code, ErrorCode::no_area);
  const Region wire = Region::create({{}, {{{0, 0}, {1, 1}}}, {}}).value();
  EXPECT_EQ(PlanarDepth::create(wire, square(1)).error().code, ErrorCode::unsupported_operand);
  EXPECT_THROW(PlanarDepth::create(square(1), square(1)).value().at({std::numeric_limits<double>::infinity(), 0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace dymsum::test
