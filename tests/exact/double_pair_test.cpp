// Pairs of doubles against exact rationals, and decimal text of rationals against what the C library prints of doubles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "exact/big.h"
#include "exact/interval.h"

namespace dymsum::exact {
namespace {

using base::exact_sum;

constexpr unsigned kPairSeed = 4711;

BigRational value_of_pair(DoublePair v) { return exact_value(v.high) + exact_value(v.low); }
BigRational power(int exponent) {
  const BigInteger p = BigInteger(1) << std::abs(exponent);
  return exponent < 0 ? BigRational(1, p) : BigRational(p);
}
bool within(const BigRational& v, const BigRational& wanted, int exponent) {
  return abs(BigRational(v - wanted)) <= abs(wanted) * power(exponent);
}

TEST(DoublePair, IntegersOfEverySizeKeep104Bits) {
  SCOPED_TRACE(kPairSeed);
  std::mt19937_64 random(kPairSeed);
  for (int round = 0; round < 4000; ++round) {
    const int bits = static_cast<int>(random() % 500);
    BigInteger v = 0;
    for (int k = 0; k < bits; k += 64) v = (v << 64) + (round % 3 == 0 ? ~std::uint64_t{0} : random());
    v >>= static_cast<unsigned>((64 - bits % 64) % 64);
    if (random() % 2 == 0) v = -v;
    const Big big(v);
    ASSERT_TRUE(within(value_of_pair(integer_pair(big)), BigRational(v), -104)) << v;
    if (msb(BigInteger(abs(v) + 1)) <= 105) {
      ASSERT_EQ(value_of_pair(integer_pair(big)), BigRational(v));
    }
    if (bits > 61) continue;
    const auto small = Int<62>::from_int64(static_cast<std::int64_t>(v));
    ASSERT_EQ(value_of_pair(integer_pair(small)), BigRational(v));
    // The same in limbs, and products that need more of them than doubles hold.
    ASSERT_EQ(value_of_pair(integer_pair(Int<254>(small))), BigRational(v));
    const auto wide = small * small * small * small * small;
    ASSERT_TRUE(within(value_of_pair(integer_pair(wide)), BigRational(v) * v * v * v * v, -104)) << v;
  }
}

TEST(DoublePair, OperationsKeep100Bits) {
  SCOPED_TRACE(kPairSeed);
  std::mt19937_64 random(kPairSeed);
  std::uniform_real_distribution<double> fraction(-1, 1);
  const auto pair = [&] {
    const double high = std::ldexp(fraction(random), static_cast<int>(random() % 200) - 100);
    return exact_sum(high, high * fraction(random) * 0x1p-53);
  };
  for (int round = 0; round < 4000; ++round) {
    const DoublePair a = pair();
    // Every second time as near to the other as cancels most.
    DoublePair b = pair();
    if (round % 2 == 0) b = exact_sum(-a.high, std::nextafter(-a.low, 1));
    ASSERT_TRUE(within(value_of_pair(a + b), value_of_pair(a) + value_of_pair(b), -100));
    ASSERT_TRUE(within(value_of_pair(a - b), value_of_pair(a) - value_of_pair(b), -100));
    ASSERT_TRUE(within(value_of_pair(a * b), value_of_pair(a) * value_of_pair(b), -100));
    ASSERT_TRUE(within(value_of_pair(a / b), value_of_pair(a) / value_of_pair(b), -100));
  }
}

TEST(DecimalText, PrintsDoublesAsTheCLibraryDoes) {
  SCOPED_TRACE(kPairSeed);
  std::mt19937_64 random(kPairSeed);
  for (int round = 0; round < 3000; ++round) {
    double v = std::bit_cast<double>(random());
    if (round < 40) v = std::ldexp(round % 2 == 0 ? 1.0 : -9.5, round - 20);
    if (!std::isfinite(v)) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%.16e", v);
    ASSERT_EQ(decimal_text(exact_value(v), 17), text);
    std::snprintf(text, sizeof text, "%.2e", v);
    ASSERT_EQ(decimal_text(exact_value(v), 3), text);
  }
}

TEST(DecimalText, RoundsHalfToEvenAtAnySize) {
  EXPECT_EQ(decimal_text(0, 17), "0");
  EXPECT_EQ(decimal_text(BigRational(2, 3), 5), "6.6667e-01");
  EXPECT_EQ(decimal_text(125, 2), "1.2e+02");
  EXPECT_EQ(decimal_text(135, 2), "1.4e+02");
  EXPECT_EQ(decimal_text(-9996, 3), "-1.00e+04");
  EXPECT_EQ(decimal_text(7, 1), "7e+00");
  const BigInteger large = boost::multiprecision::pow(BigInteger(10), 5000);
  EXPECT_EQ(decimal_text(BigRational(large) * 12345 + 1, 4), "1.235e+5004");  // a hair above the middle
  EXPECT_EQ(decimal_text(BigRational(1) / BigRational(large), 3), "1.00e-5000");
}

}  // namespace
}  // namespace dymsum::exact
