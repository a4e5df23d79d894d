// The vocabulary of bounds against exact values; the filter of plain signs holds its bound and comes near it.
#include "exact/rounding_bound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact/big.h"
#include "exact/orient.h"
#include "oracles/random.h"

namespace dymsum::exact {
namespace {

TEST(RoundingBound, gamma_covers_products_of_roundings_and_hardly_more) {
  const BigRational u = exact_value(kRoundoff);
  for (int n = 1; n <= 1 << 20; n = n < 64 ? n + 1 : 2 * n + 1) {
    const BigRational truth = n * u / (1 - n * u), above = exact_value(gamma(n));
    EXPECT_GE(above, truth) << n;
    EXPECT_LE(above, truth * (1 + 5 * n * u)) << n;
  }
}

TEST(RoundingBound, outwards_and_inwards_cover_many_roundings) {
  BigRational low = 1, high = 1;
  const BigRational u = exact_value(kRoundoff);
  for (int k = 0; k < 12; ++k) {
    low = k == 0 ? BigRational(1 - u) : BigRational(low * low);
    high = k == 0 ? BigRational(1 + u) : BigRational(high * high);
  }
  EXPECT_GE(low * exact_value(kOutwards), 1);
  EXPECT_LE(high * exact_value(kInwards), 1);
}

TEST(RoundingBound, floats_outwards_are_not_below_their_doubles) {
  oracles::Random random(6);
  int below = 0;
  for (int k = 0; k < 20000; ++k) {
    const double e = std::abs(random.signed_unit()) + 0x1p-100;
    EXPECT_GE(static_cast<double>(static_cast<float>(e) * kFloatOutwards), e);
    below += static_cast<double>(static_cast<float>(e) * (1 + (kFloatOutwards - 1) / 32)) < e;
  }
  EXPECT_GT(below, 0);
}

TEST(RoundingBound, sixteen_values_lose_less_than_is_added_for_subnormals) {
  oracles::Random random(7);
  BigRational lost = 0, largest = 0;
  for (int k = 0; k < 20000; ++k) {
    const BigRational v = exact_value(std::abs(random.signed_unit())) * exact_value(0x1p-1070) / 7;
    lost = abs(BigRational(exact_value(round_to_double(v)) - v));
    largest = std::max(largest, lost);
  }
  EXPECT_LE(16 * largest, exact_value(kSubnormal));
  EXPECT_GT(32 * largest * 2, exact_value(kSubnormal));
}

TEST(RoundingBound, plain_signs_err_by_less_and_not_by_much_less) {
  oracles::Random random(5);
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    const double a = random.signed_unit(), b = random.signed_unit() * 0x1p-3, c = random.signed_unit(),
                 d = random.signed_unit() * 0x1p-3, e = random.signed_unit(), f = random.signed_unit() * 0x1p-3,
                 g = random.signed_unit(), h = random.signed_unit() * 0x1p-3;
    const double l = (b - a) * (d - c), r = (f - e) * (h - g), bound = kProvedSign * (std::abs(l) + std::abs(r));
    const auto minus = [](double x, double y) { return BigRational(exact_value(x) - exact_value(y)); };
    const BigRational truth = minus(b, a) * minus(d, c) + minus(f, e) * minus(h, g);
    most = std::max(most, round_to_double(BigRational(abs(exact_value(l + r) - truth))) / bound);
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.25);
}

}  // namespace
}  // namespace dymsum::exact
