// Intervals of seventy digits against exact rationals.
#include "exact/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact/big.h"

namespace dymsum::exact {
namespace {

constexpr unsigned kWideSeed = 81321;

/// A number within 2^-400 of a rational one.
WideInterval near(const BigRational& v) {
  constexpr int kBits = 400;
  const BigRational scaled = v * BigRational(BigInteger(1) << kBits);
  return WideInterval::around(numerator(scaled) / denominator(scaled), BigInteger(1), -kBits);
}
/// What is not certain to lie outside.
bool may_hold(const WideInterval& a, const BigRational& v) {
  const std::optional<int> s = sign_of(a - near(v));
  return !s || *s == 0;
}

TEST(WideInterval, holds_the_value_of_sums_and_products) {
  std::mt19937_64 random(kWideSeed);
  std::uniform_real_distribution<double> fraction(-1, 1);
  int proved = 0, zeros = 0, narrow = 0;
  for (int round = 0; round < 3000; ++round) {
    // Of sizes down to what units cut off, and differences of neighbours.
    std::vector<WideInterval> wide;
    std::vector<BigRational> exact;
    for (int k = 0; k < 6; ++k) {
      double v = std::ldexp(fraction(random), 8 - static_cast<int>(random() % (round % 2 == 0 ? 40 : 280)));
      if (random() % 8 == 0) v = 0;
      wide.push_back(WideInterval::of(v)), exact.push_back(exact_value(v));
      ASSERT_TRUE(may_hold(wide.back(), exact.back())) << v;
    }
    for (int step = 0; step < 8; ++step) {
      const std::size_t i = random() % wide.size(), j = random() % wide.size();
      const int kind = static_cast<int>(random() % 4);
      wide.push_back(kind == 0   ? wide[i] + wide[j]
                     : kind == 1 ? wide[i] - wide[j]
                     : kind == 2 ? -wide[i]
                                 : wide[i] * wide[j]);
      exact.push_back(kind == 0   ? BigRational(exact[i] + exact[j])
                      : kind == 1 ? BigRational(exact[i] - exact[j])
                      : kind == 2 ? BigRational(-exact[i])
                                  : BigRational(exact[i] * exact[j]));
      if (abs(exact.back()) > exact_value(0x1p100)) {
        wide.pop_back(), exact.pop_back();
        continue;
      }
      const WideInterval& a = wide.back();
      const BigRational& v = exact.back();
      ASSERT_TRUE(may_hold(a, v)) << "round " << round << ", step " << step;
      narrow += a.radius() < 0x1p-200;
      const std::optional<int> s = sign_of(a);
      if (!s) continue;
      ASSERT_EQ(*s, v.sign()) << "round " << round << ", step " << step;
      ++proved, zeros += *s == 0;
    }
  }
  EXPECT_GT(proved, 15000);
  EXPECT_GT(zeros, 500);
  EXPECT_GT(narrow, 12000);
}

TEST(WideInterval, takes_numbers_of_any_size_with_their_errors) {
  std::mt19937_64 random(kWideSeed);
  for (int round = 0; round < 2000; ++round) {
    BigInteger value = 0, error = 0;
    for (int k = static_cast<int>(random() % 9); k >= 0; --k) value = (value << 64) + random();
    for (int k = static_cast<int>(random() % 3); k > 0; --k) error = (error << 64) + random();
    if (random() % 2 == 0) value = -value;
    const long bits = value.is_zero() ? 0 : static_cast<long>(msb(BigInteger(abs(value))));
    const long shift = static_cast<long>(random() % 500) - bits - 430;
    const WideInterval a = WideInterval::around(value, error, shift);
    const BigRational unit = shift < 0 ? BigRational(1, BigInteger(1) << -shift) : BigRational(BigInteger(1) << shift);
    for (const BigInteger& at : {value, BigInteger(value - error), BigInteger(value + error)})
      ASSERT_TRUE(may_hold(a, at * unit)) << value << " 2^" << shift;
    if (const std::optional<int> s = sign_of(a)) {
      ASSERT_EQ(*s, BigInteger(value - error).sign());
      ASSERT_EQ(*s, BigInteger(value + error).sign());
    }
  }
  // Just inside, and too large.
  EXPECT_EQ(sign_of(WideInterval::around((BigInteger(1) << 62) - 1, 0, 0)), 1);
  EXPECT_TRUE(WideInterval::around(BigInteger(1) << 62, 0, 0).is_whole());
  EXPECT_TRUE(WideInterval::around(1, 0, 5000).is_whole());
  EXPECT_TRUE(WideInterval::around(1, BigInteger(1) << 70, 0).is_whole());
  EXPECT_EQ(sign_of(WideInterval::around(1, 0, -5000)), std::nullopt);
  EXPECT_TRUE(WideInterval::of(0x1p80).is_whole());
  EXPECT_TRUE(WideInterval::of(std::nan("")).is_whole());
  const WideInterval most = WideInterval::around((BigInteger(1) << 62) - 1, 0, 0);
  EXPECT_TRUE((most + most).is_whole());
  EXPECT_TRUE((-most - most).is_whole());
  EXPECT_TRUE((most * WideInterval(2)).is_whole());
  EXPECT_FALSE((most * WideInterval(1)).is_whole());
  EXPECT_EQ(sign_of(WideInterval::whole() * WideInterval(0)), 0);
  EXPECT_EQ(sign_of(most - most), 0);
  EXPECT_EQ(sign_of(WideInterval(-3) * WideInterval(3)), -1);
}

}  // namespace
}  // namespace dymsum::exact
