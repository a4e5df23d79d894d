// Sums of lengths: the nearest doubles, also beside ties of two and on them.
#include "spatial/mesh/wide_sum.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;

exact::Vector3<Big> exact_vector(const BigInteger& x, const BigInteger& y, const BigInteger& z) {
  return {Big(x), Big(y), Big(z)};
}

TEST(LengthSum, is_the_nearest_double) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    LengthSum sum;
    mpf_class total(0, 2000);
    for (int k = 0; k < 1 + round % 7; ++k) {
      const auto any = [&] { return static_cast<long>(random() % 4001) - 2000; };
      const long x = any(), y = any(), z = any();
      sum.vectors.push_back(exact_vector(x, y, z));
      mpf_class square(x * x + y * y + z * z, 2000);
      total += sqrt(square);
    }
    sum.unit = BigRational(round + 1, 3);
    total *= round + 1, total /= 3;
    const double value = sum.nearest();
    const mpf_class off = abs(total - value);
    EXPECT_LE(off, abs(total - std::nextafter(value, 0)));
    EXPECT_LE(off, abs(total - std::nextafter(value, INFINITY)));
  }
}

TEST(LengthSum, of_a_tie_is_even_and_beside_a_tie_is_on_its_side) {
  const BigInteger big = BigInteger(1) << 253, one = BigInteger(1) << 200;
  const auto sum = [&](const BigInteger& x, int y) {
    return LengthSum{{exact_vector(big, 0, 0), exact_vector(x, y, 0)}, BigRational(1, one)}.nearest();
  };
  EXPECT_EQ(sum(one, 0), 0x1p53) << "a tie";
  EXPECT_EQ(sum(3 * one, 0), 0x1p53 + 4) << "a tie";
  EXPECT_EQ(sum(one, 1), 0x1p53 + 2) << "2^-401 above a tie";
  EXPECT_EQ(sum(3 * one - 1, 1), 0x1p53 + 2) << "2^-200 below a tie";
}

TEST(LengthSum, has_any_size) {
  EXPECT_EQ(LengthSum{}.nearest(), 0);
  EXPECT_EQ(LengthSum{}.text(), "0");
  const LengthSum tiny{{exact_vector(1, 1, 0)}, BigRational(1, BigInteger(1) << 1070)};
  EXPECT_EQ(tiny.nearest(), std::ldexp(std::sqrt(2.0), -1070)) << "subnormal: sqrt 2 2^-1070 is nearest to 23 2^-1074";
  const LengthSum huge{{exact_vector(3, 4, 0)}, BigRational(BigInteger(1) << 2000)};
  EXPECT_TRUE(std::isinf(huge.nearest()));
  EXPECT_EQ(huge.text().substr(0, 4), "5.74");  // 5 2^2000
}

}  // namespace
}  // namespace dymsum::spatial
