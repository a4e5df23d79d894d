// Bounds of sample points of a window against exact values: they hold, and are not many times too large.
#include <gtest/gtest.h>

#include "exact/big.h"
#include "oracles/random.h"
#include "planar/motion/operand_pair.h"

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

}  // namespace
}  // namespace dymsum::planar
