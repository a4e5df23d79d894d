// Values at a root: signs that only a remainder decides, and doubles as near as they can be.
#include "exact/algebraic_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dymsum::exact {
namespace {

/// The positive root of t^2 - 2.
AlgebraicRoot root_of_two() {
  return roots_in(Polynomial({Big::from_int64(-2), Big::from_int64(0), Big::from_int64(1)}), 0, 2).at(0);
}

TEST(RootValue, SignsAreThoseOfTheNumber) {
  const RootPoint point(root_of_two());
  const RootValue t(Terms{0, 1}, &point), two = RootValue::from_int64(2), one = RootValue::from_int64(1);
  EXPECT_EQ(sign(t * t - two), 0);
  EXPECT_TRUE(t * t * t == two * t);
  // (t - 1)^40 is 2^-51, and a - b t for the 40th power of 1 - sqrt(2).
  RootValue power = one;
  for (int k = 0; k < 40; ++k) power = power * (t - one);
  EXPECT_EQ(sign(power), 1);
  EXPECT_EQ(sign(power * (one - t)), -1);
  EXPECT_NEAR(to_double(power) / std::pow(std::sqrt(2.0) - 1, 40), 1, 1e-13);
  EXPECT_EQ(to_double(t), std::sqrt(2.0));
  EXPECT_EQ(to_double(t * t), 2);
  EXPECT_THROW(static_cast<void>(sign(RootValue(Terms{0, 1}))), std::logic_error);
  EXPECT_THROW(static_cast<void>(to_big(t)), std::logic_error);
}

TEST(RootValue, RationalRootsAreRootsToo) {
  const RootPoint third(AlgebraicRoot::rational(BigRational(1, 3)));
  const RootValue t(Terms{0, 1}, &third);
  EXPECT_EQ(sign(t * RootValue::from_int64(3) - RootValue::from_int64(1)), 0);
  EXPECT_EQ(to_double(t), 1.0 / 3);
}

TEST(RootValue, DivisionTakesOutFactorsAlone) {
  const Terms weight{1, 0, 14};
  Terms a = product_of(Terms{3, -2, 5}, weight), b = sum_of(a, Terms{1});
  EXPECT_TRUE(divide_exactly(a, weight));
  EXPECT_EQ(a, (Terms{3, -2, 5}));
  const Terms before = b;
  EXPECT_FALSE(divide_exactly(b, weight));
  EXPECT_EQ(b, before);
}

}  // namespace
}  // namespace dymsum::exact
