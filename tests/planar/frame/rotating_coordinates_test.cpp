// Turning sums of huge and minute coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "dymsum/shapes.h"
#include "planar/frame/rotating_frames.h"

namespace dymsum {
namespace {

using rotating_frames::expect_frame;

// Positions round to few digits there, which the stated error has to decide.
TEST(RotatingSum, rings_begin_at_their_smallest_vertex_among_subnormal_numbers) {
  std::size_t frames = 0;
  for (const int exponent : {-1040, -1060, -1070}) {
    const auto region = [&](Ring ring) {
      for (Point& v : ring) v = {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent)};
      return Region::create({{{ring, {}}}, {}, {}}).value();
    };
    const Region p = region({{0, 0}, {5, 1}, {9, 7}, {2, 4}}), q = region({{0, 0}, {3, 0}, {3, 4}, {0, 4}});
    for (const MovingOperand moving : {MovingOperand::p, MovingOperand::q}) {
      MovingOptions options;
      options.moving = moving;
      options.mode = FrameMode::window;
      RotatingSum sum = RotatingSum::create(p, q, options).value();
      for (int k = 1; k < 60; ++k) {
        ASSERT_TRUE(sum.set(rotating_frames::at(0.05 * k)).ok());
        frames += !sum.work().rebuilt;
        if (moving == MovingOperand::p)
          expect_frame(sum, rotated_sum(p, q, rotating_frames::at(0.05 * k)).value(), false);
        for (const SumVertex& v : sum.sum().parts[0].outer.vertices) {
          const RationalPoint exact = sum.sum().exact(v), first = sum.sum().exact(sum.sum().parts[0].outer.vertices[0]);
          EXPECT_FALSE(exact.x < first.x || (exact.x == first.x && exact.y < first.y)) << exponent << " " << k;
          EXPECT_LE(std::abs(exact.x.to_double() - v.at.x), sum.sum().at_error + 0x1p-1074);
          EXPECT_LE(std::abs(exact.y.to_double() - v.at.y), sum.sum().at_error + 0x1p-1074);
        }
      }
    }
  }
  EXPECT_GT(frames, 200u);
}

// Products of coordinates that over- or underflow leave signs undecided, never wrong.
TEST(RotatingSum, huge_and_minute_coordinates_equal_slices) {
  const auto scaled = [](const Region& region, int exponent) {
    RegionData data = region.data();
    for (Part& part : data.parts)
      for (Point& v : part.outer) v = {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent)};
    return Region::create(data).value();
  };
  for (const auto& [one, other] : {std::pair{390, 390}, {-380, -380}, {980, 980}, {-900, -900}, {390, 300}, {0, 60}}) {
    const Region p = scaled(shapes::noisy_star(20, 0.6, 1), one), q = scaled(shapes::noisy_star(14, 0.7, 2), other);
    MovingOptions options;
    options.mode = FrameMode::window;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    for (int k = 1; k < 12; ++k) {
      const Orientation theta = rotating_frames::at(0.012 * k);
      ASSERT_TRUE(sum.set(theta).ok());
      ASSERT_TRUE(sum.sum() == rotated_sum(p, q, theta).value()) << one << ", " << other << ", frame " << k;
    }
  }
}

}  // namespace
}  // namespace dymsum
