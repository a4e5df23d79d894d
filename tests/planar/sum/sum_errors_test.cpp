// Operands that no sum can take are refused with their own coordinate, also where the engine sees them reflected or
// inside a frame.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/scale_range.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

Region triangle(double x) { return Region::create({{{{{0, 0}, {x, 0}, {0, 1}}, {}}}, {}, {}}).value(); }

template <class T>
void expect_named(const Result<T>& result, double x) {
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(result.error().evidence.x, x) << result.error().to_string();
  EXPECT_EQ(result.error().evidence.y, 0.0);
  EXPECT_FALSE(std::signbit(*result.error().evidence.y)) << result.error().to_string();
}

TEST(SumErrors, huge_coordinates_are_told_as_the_operand_has_them) {
  const Region huge = triangle(0x1p1001), small = triangle(1);
  expect_named(minkowski_sum(huge, small), 0x1p1001);
  expect_named(minkowski_sum(small, huge), 0x1p1001);
  expect_named(nfp(huge, small), 0x1p1001);
  expect_named(nfp(small, huge), 0x1p1001);
  expect_named(erode(huge, small), 0x1p1001);
  expect_named(erode(small, huge), 0x1p1001);
  MovingOptions options;
  options.reflect_q = true;
  expect_named(ScalingSum::create(small, huge, options), 0x1p1001);
  expect_named(scale_range(huge, {{0, 0}}, small), 0x1p1001);
  expect_named(scale_range(small, {{0, 0}}, huge), 0x1p1001);
  expect_named(fit_range(huge, small), 0x1p1001);
  expect_named(fit_range(small, huge), 0x1p1001);
  expect_named(fit_range(small, huge, {0, 0}), 0x1p1001);
}

TEST(SumErrors, an_erosion_leaves_room_for_its_frame) {
  const Region small = triangle(1);
  expect_named(erode(triangle(0x1p997), small), 0x1p997);
  const Region large = shapes::rectangle(0, 0, 0x1p996, 0x1p996);
  const Result<PlanarSum> room = erode(large, shapes::rectangle(0, 0, 1, 1));
  ASSERT_TRUE(room.ok()) << room.error().to_string();
  EXPECT_EQ(room->parts.size(), 1u);
}

}  // namespace
}  // namespace dymsum
