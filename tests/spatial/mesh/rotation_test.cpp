#include "dymsum/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "exact/int.h"

namespace dymsum::test {
namespace {

using I = exact::i128;

TEST(Rotation, matrices_are_exactly_orthogonal_at_the_largest_components) {
  const std::int64_t m = std::int64_t{1} << Rotation::kBits;
  for (const Rotation& r :
       {*Rotation::of(m, m - 1, -m, m - 3), *Rotation::of(1, m, m, -m), *Rotation::of(3, -1, 2, 5), Rotation()}) {
    const auto n = r.matrix();
    const I size = r.norm();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        // 2^124 per product: three of them fit.
        const I dot = I(n[3 * i]) * n[3 * j] + I(n[3 * i + 1]) * n[3 * j + 1] + I(n[3 * i + 2]) * n[3 * j + 2];
        EXPECT_TRUE(dot == (i == j ? size * size : 0));
      }
  }
}

TEST(Rotation, composes_as_matrices_do) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> small(-1000, 1000);
  for (int k = 0; k < 200; ++k) {
    const Result<Rotation> a = Rotation::of(small(random), small(random), small(random), small(random));
    const Result<Rotation> b = Rotation::of(small(random), small(random), small(random), small(random));
    if (!a || !b) continue;
    const Rotation c = *a * *b;
    const auto x = a->matrix(), y = b->matrix(), z = c.matrix();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const I product = I(x[3 * i]) * y[j] + I(x[3 * i + 1]) * y[3 + j] + I(x[3 * i + 2]) * y[6 + j];
        EXPECT_TRUE(product * c.norm() == I(z[3 * i + j]) * (I(a->norm()) * b->norm()));
      }
    EXPECT_EQ(*a * a->inverse(), Rotation());
  }
}

TEST(Rotation, numbers_whose_sum_overflows_are_finite) {
  for (const double huge : {8.9e307, std::numeric_limits<double>::max()}) {
    const Result<Rotation> nearest = Rotation::nearest(huge, huge, -huge, huge);
    ASSERT_TRUE(nearest.ok());
    EXPECT_EQ(*nearest, *Rotation::of(1, 1, -1, 1));
    const Result<Rotation> about = Rotation::about({huge, huge, huge}, 1);
    ASSERT_TRUE(about.ok());
    EXPECT_EQ(*about, *Rotation::about({1, 1, 1}, 1));
  }
}

TEST(Rotation, compositions_do_not_grow_and_err_by_the_stated_angle) {
  const Rotation step = *Rotation::about({1, 2, 3}, 0.01);
  Rotation r;
  for (int k = 1; k <= 300; ++k) {
    r = step * r;
    for (const std::int64_t c : r.quaternion()) EXPECT_LE(std::abs(c), std::int64_t{1} << Rotation::kBits);
    EXPECT_NEAR(r.angle(), 0.01 * k, (k + 1) * Rotation::kAngularError + 1e-12);
  }
}

TEST(Rotation, quarter_and_half_turns_about_the_axes_are_exact) {
  const double pi = std::acos(-1.0);
  EXPECT_EQ(*Rotation::about({0, 0, 1}, pi / 2), *Rotation::of(1, 0, 0, 1));
  EXPECT_EQ(*Rotation::about({0, 2, 0}, -pi / 2), *Rotation::of(1, 0, -1, 0));
  EXPECT_EQ(*Rotation::about({1, 0, 0}, pi), *Rotation::of(0, 1, 0, 0));
  EXPECT_EQ(*Rotation::of(-2, 4, 0, 2), *Rotation::of(1, -2, 0, -1));
  EXPECT_EQ(*Rotation::about({0, 0, 1}, 0), Rotation());
}

TEST(Rotation, bad_numbers_are_told) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Rotation::of(0, 0, 0, 0).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::of((std::int64_t{1} << 30) + 1, 1, 0, 0).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::about({0, 0, 0}, 1).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::about({0, nan, 1}, 1).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::about({0, 0, 1}, inf).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::nearest(0, 0, 0, 0).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Rotation::nearest(nan, 0, 0, 1).error().code, ErrorCode::bad_rotation);
  EXPECT_TRUE(Rotation::of(std::int64_t{1} << 40, 0, 0, 0).ok()) << "a common divisor is no size";
}

}  // namespace
}  // namespace dymsum::test
