// Options of moving sums: what is out of range is an error, and extreme values in range are right.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

MovingOptions reaching(double window) {
  MovingOptions options;
  options.window = window;
  options.mode = FrameMode::window;
  return options;
}

TEST(MovingOptions, out_of_range_they_are_errors) {
  const Region p = shapes::letter_u(4, 4, 1), q = shapes::letter_l(3, 3, 1);
  MovingOptions threads;
  threads.threads = -1;
  for (const MovingOptions& options :
       {reaching(NAN), reaching(INFINITY), reaching(-INFINITY), reaching(-1), reaching(-5e-324), threads}) {
    const auto scaling = ScalingSum::create(p, q, options);
    ASSERT_FALSE(scaling.ok()) << options.window;
    EXPECT_EQ(scaling.error().code, ErrorCode::out_of_range);
    const auto rotating = RotatingSum::create(p, q, options);
    ASSERT_FALSE(rotating.ok()) << options.window;
    EXPECT_EQ(rotating.error().code, ErrorCode::out_of_range);
    const auto copies = scaled_copies(p, q, {{}}, options);
    ASSERT_FALSE(copies.ok()) << options.window;
    EXPECT_EQ(copies.error().code, ErrorCode::out_of_range);
  }
}

TEST(MovingOptions, windows_of_scales_are_right_however_wide) {
  const Region p = shapes::noisy_star(12, 0.5, 1), q = shapes::noisy_star(9, 0.5, 2);
  for (const double width : {5e-324, 1.0, 1e3, 1e30, 1e300, std::numeric_limits<double>::max()}) {
    ScalingSum moving = ScalingSum::create(p, q, reaching(width)).value();
    MovingOptions rebuilt;
    rebuilt.mode = FrameMode::rebuild;
    ScalingSum fresh = ScalingSum::create(p, q, rebuilt).value();
    for (const double s : {1.001, 1.7, 0.9, 100.3, 0x1p64, 0x1p-64, 0.03}) {
      ASSERT_TRUE(moving.set(s).ok()) << width;
      ASSERT_TRUE(fresh.set(s).ok());
      ASSERT_TRUE(moving.sum() == fresh.sum()) << width << " at " << s;
    }
  }
}

}  // namespace
}  // namespace dymsum
