// Integers as intervals of two doubles: they hold them, and as tightly as two doubles can.
#include "exact/leading_digits.h"

#include <gtest/gtest.h>

#include <random>

#include "exact/big.h"

namespace dymsum::exact {
namespace {

BigRational power_of_2(int exponent) {
  const BigInteger p = BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? BigRational(1, p) : BigRational(p);
}

/// How far an interval reaches to either side of a number, as intervals of doubles show: its leading double is
/// taken off first, which two doubles do exactly.
void expect_tight(const FineInterval& interval, const BigRational& v, int digits) {
  const double lead = round_to_double(v);
  const Interval left = (interval + FineInterval(-lead)).rounded();
  const BigRational rest = v - exact_value(lead), low = exact_value(left.low()), high = exact_value(left.high());
  EXPECT_LE(low, rest) << digits;
  EXPECT_LE(rest, high) << digits;
  const BigRational size = v < 0 ? BigRational(-v) : v;
  // The sums above err by as much as two doubles do, and by the least doubles.
  const BigRational error = digits > 106 ? BigRational(size * power_of_2(-98)) : rest < 0 ? BigRational(-rest) : rest;
  EXPECT_LE(high - low, (digits > 106 ? error : BigRational(error * power_of_2(-50))) + power_of_2(-990)) << digits;
}

TEST(LeadingDigits, HoldIntegersOfEveryLength) {
  std::mt19937_64 random(2718);
  for (int bits = 1; bits <= 249; ++bits) {
    for (int k = 0; k < 24; ++k) {
      BigInteger v = 0;
      for (int limb = 0; limb < 4; ++limb) v = (v << 64) + random();
      v = v % (BigInteger(1) << static_cast<unsigned>(bits - 1)) + (BigInteger(1) << static_cast<unsigned>(bits - 1));
      // All digits from some position on are zeros, or ones.
      const auto position = static_cast<unsigned>(random() % static_cast<std::uint64_t>(bits));
      if (k % 3 == 1) v = (v >> position) << position;
      if (k % 3 == 2) v |= (BigInteger(1) << position) - 1;
      if (k % 2 == 1) v = -v;
      const int shift = static_cast<int>(random() % 500) - 450;
      const FineInterval interval = leading_digits(narrowed<Int<250>>(Big(v)), shift);
      expect_tight(interval, BigRational(v) * power_of_2(shift), bits);
    }
  }
}

TEST(LeadingDigits, OfZeroAndOfAllButNothing) {
  EXPECT_TRUE(leading_digits(Int<250>::from_int64(0), 5).rounded().is_point());
  for (const int shift : {-789, -790, -791, -792, -900, -1100, -4000}) {
    for (const int v : {1, -1, 3}) {
      const Interval at = leading_digits(Int<250>::from_int64(v), shift).rounded();
      const BigRational exact = BigRational(v) * power_of_2(shift);
      EXPECT_TRUE(exact_value(at.low()) <= exact && exact <= exact_value(at.high())) << v << " " << shift;
      EXPECT_LE(at.high(), std::ldexp(1.0, std::max(-899, shift + 3))) << v << " " << shift;
    }
  }
}

}  // namespace
}  // namespace dymsum::exact
