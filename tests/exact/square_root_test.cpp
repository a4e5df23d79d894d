// Roots rounded once, against the definition.
#include "exact/big.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace dymsum::exact {
namespace {

/// Whether r is a double nearest to the root of v: both middles towards its neighbours are on the right sides.
void expect_nearest_root(double r, const BigRational& v) {
  const BigRational at = exact_value(r), below = (at + exact_value(std::nextafter(r, 0))) / 2;
  EXPECT_LE(below * below, v) << r;
  const double up = std::nextafter(r, std::numeric_limits<double>::infinity());
  if (!std::isfinite(up)) return;
  const BigRational above = (at + exact_value(up)) / 2;
  EXPECT_GE(above * above, v) << r;
}

TEST(SquareRoot, is_the_nearest_double_whatever_the_size) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 2000; ++k) {
    const int shift = static_cast<int>(random() % 4200) - 2140;
    const BigInteger num = BigInteger(random()) * random(), den = BigInteger(random() >> (random() % 60)) + 1;
    const BigInteger power = BigInteger(1) << static_cast<unsigned>(std::abs(shift));
    const BigRational v =
        shift < 0 ? BigRational(num, BigInteger(den * power)) : BigRational(BigInteger(num * power), den);
    const double r = root_to_double(v);
    if (std::isfinite(r)) expect_nearest_root(r, v);
  }
}

TEST(SquareRoot, of_squares_and_of_squares_of_middles) {
  for (const double x : {1.0, 3.0, 0x1p-1074, 0x1.fffffffffffffp1023, 0x1.0000000000001p-1022, 1e-160, 0.1}) {
    const BigRational exact = exact_value(x);
    EXPECT_EQ(root_to_double(exact * exact), x);
    // Half of the last place further: the even neighbour; a hair beyond that: the upper one.
    const double up = std::nextafter(x, 1e308);
    if (!(up > x)) continue;
    const BigRational midpoint = (exact + exact_value(up)) / 2, hair(BigInteger(1), BigInteger(1) << 4000);
    EXPECT_EQ(root_to_double(midpoint * midpoint), round_to_double(midpoint));
    EXPECT_EQ(root_to_double(midpoint * midpoint + hair), up);
    EXPECT_EQ(root_to_double(midpoint * midpoint - hair), x);
  }
  EXPECT_EQ(root_to_double(0), 0);
  EXPECT_EQ(root_to_double(BigRational(BigInteger(BigInteger(1) << 2048))), std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)root_to_double(-1), std::logic_error);
}

TEST(FloorRoot, IsTheWholePartAndTheRest) {
  std::mt19937_64 random(5);
  for (int bits = 1; bits < 700; bits += 3) {
    BigInteger n = 0;
    for (int k = 0; k < bits; k += 32) n = (n << 32) + static_cast<std::uint32_t>(random());
    n >>= static_cast<unsigned>(n.is_zero() ? 0 : bits % 7);
    for (const BigInteger& value :
         {n, BigInteger(n * n), BigInteger(n * n + 2 * n), BigInteger(n * n - (n > 0 ? 1 : 0))}) {
      BigInteger rest;
      const BigInteger root = floor_root(value, rest);
      EXPECT_EQ(root * root + rest, value);
      EXPECT_GE(rest, 0);
      EXPECT_LE(rest, 2 * root);
    }
  }
}

}  // namespace
}  // namespace dymsum::exact
