// Bounds of sample points of a window against exact values: they hold, and are not many times too large.
#include <gtest/gtest.h>

#include "exact/big.h"
#include "oracles/random.h"
#include "planar/motion/scaling_forms.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

BigRational exact_of(double v) { return exact::exact_value(v); }

// Weights of lengths that are known exactly.
TEST(SampleBounds, weights_of_mediants_err_by_less_and_not_by_much_less) {
  oracles::Random random(15);
  double most = 0;
  for (int k = 0; k < 10000; ++k) {
    const double d0 = std::abs(random.signed_unit()) + 0x1p-60, d1 = std::abs(random.signed_unit()) + 0x1p-60;
    const BigRational weight = exact_of(d1) / (exact_of(d0) + exact_of(d1)),
                      off = abs(BigRational(exact_of(d1 / (d0 + d1)) / weight - 1));
    most = std::max(most, exact::round_to_double(off) / kMediant);
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 12);
}

// A pair of vertices, blown up, and how far the sample is from it, rounded from the exact vector.
TEST(SampleBounds, samples_err_by_less_and_not_by_much_less) {
  oracles::Random random(16);
  double most = 0;
  for (int k = 0; k < 10000; ++k) {
    const int fixed = random.below(3), moving = fixed == 0 ? 1 : random.below(3);
    const double span = fixed + 2.0 * moving;
    const BigRational scale(random.below(1000) + 1, 1001), grow(random.below(1000) + 1001, 1001);  // tau1 = 1
    const auto coordinate = [&](int extent) {
      return BigRational(exact_of(std::abs(random.signed_unit()) * extent) + exact_of(random.signed_unit() * 0x1p-52));
    };
    const auto near = [](const BigRational& v) { return exact::round_to_double(v); };
    const BigRational f = coordinate(fixed), m = coordinate(moving),
                      farther = exact_of(random.signed_unit() * span) / 3;
    const double value = near(grow) * (near(f) + near(scale) * near(m)) + near(farther);
    const BigRational off = abs(BigRational(exact_of(value) - (grow * (f + scale * m) + farther)));
    most = std::max(most, near(off) / (near(grow) * kWindowSample * span));
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 32);
}

}  // namespace
}  // namespace dymsum::planar
