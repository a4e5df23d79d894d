#include "exact/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "exact/big.h"
#include "exact/gmp_bridge.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kGridSeed = 4711;
constexpr double kMax = std::numeric_limits<double>::max();

mpq_class power_of_two(int e) {
  return e >= 0 ? mpq_class(mpz_class(1) << e) : mpq_class(mpz_class(1), mpz_class(1) << -e);
}

double random_double(std::mt19937_64& random) {
  for (;;) {
    std::uint64_t bits = random();
    if (random() % 2) bits &= ~std::uint64_t{0} << (random() % 53);  // short mantissas
    const double v = std::bit_cast<double>(bits);
    if (std::isfinite(v)) return v;
  }
}

/// A double m 2^e near 1 with few or many bits, as in real files.
double everyday_double(std::mt19937_64& random) {
  const auto m = static_cast<double>(static_cast<std::int64_t>(random() >> (11 + random() % 40)));
  return std::ldexp(random() % 2 ? m : -m, -static_cast<int>(random() % 40));
}

TEST(Grid, DyadicPartsGiveTheNumberBack) {
  std::mt19937_64 random = seeded(kGridSeed);
  for (int i = 0; i < 20000; ++i) {
    const double v = random_double(random);
    const Dyadic d = to_dyadic(v);
    if (v == 0) continue;
    ASSERT_NE(d.mantissa % 2, 0) << v;
    ASSERT_EQ(mpq_class(static_cast<long>(d.mantissa)) * power_of_two(d.exponent), mpq_class(v));
  }
  EXPECT_EQ(to_dyadic(0.0).mantissa, 0);
  EXPECT_EQ(to_dyadic(-0.0).mantissa, 0);
  EXPECT_EQ(to_dyadic(0x1p-1074).exponent, -1074);
  EXPECT_EQ(to_dyadic(0x1p1023).exponent, 1023);
  EXPECT_EQ(to_dyadic(kMax).exponent, 971);
}

TEST(Grid, TheCommonUnitDividesEverythingAndTwiceTheUnitDoesNot) {
  std::mt19937_64 random = seeded(kGridSeed);
  for (int i = 0; i < 300; ++i) {
    std::vector<double> x, y;
    for (int k = 0; k < 5; ++k) {
      x.push_back(i % 2 ? everyday_double(random) : random_double(random));
      y.push_back(i % 2 ? everyday_double(random) : random_double(random));
    }
    y.push_back(0);
    const int e = common_exponent(x, y);
    bool twice = true;
    for (const auto* span : {&x, &y})
      for (const double v : *span) {
        const mpq_class q = mpq_class(v) / power_of_two(e);
        ASSERT_EQ(q.get_den(), 1) << v;
        twice = twice && q.get_num() % 2 == 0;
      }
    ASSERT_FALSE(twice);
    ASSERT_EQ(common_exponent(y, x), e);
  }
  const std::vector<double> zeros = {0.0, -0.0}, some = {12, 20, 0};
  EXPECT_EQ(common_exponent(zeros), 0);
  EXPECT_EQ(common_exponent(std::span<const double>{}), 0);
  EXPECT_EQ(common_exponent(some), 2);
  EXPECT_EQ(common_exponent(zeros, some), 2);  // a set of zeros has no say
  const std::vector<double> halves = {0.5, 0x1p-1074};
  EXPECT_EQ(common_exponent(halves), -1074);
}

TEST(Grid, BitsNeededIsSmallest) {
  std::mt19937_64 random = seeded(kGridSeed + 1);
  const auto holds = [](int bits, const mpq_class& v, int e) { return abs(v) <= power_of_two(bits) * power_of_two(e); };
  for (int i = 0; i < 20000; ++i) {
    const bool wild = i % 2 == 0;
    const double a = wild ? random_double(random) : everyday_double(random);
    double b = wild ? random_double(random) : everyday_double(random);
    if (i % 5 == 0) b = std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
    if (i % 7 == 0) b = std::nextafter(a, b);
    if (i % 11 == 0) b = a + std::ldexp(1.0, std::ilogb(a == 0 ? 1 : a) + static_cast<int>(random() % 20) - 10);
    if (!std::isfinite(b)) continue;
    const std::vector<double> both = {a, b};
    const int e = common_exponent(both);
    const mpq_class difference = mpq_class(b) - mpq_class(a);
    const int bits = bits_needed(b, b, a, e);
    ASSERT_TRUE(holds(bits, difference, e)) << a << ' ' << b;
    if (bits > 0) {
      ASSERT_FALSE(holds(bits - 1, difference, e)) << a << ' ' << b;
    }
    const int plain = bits_needed(std::abs(a), e);
    ASSERT_TRUE(holds(plain, mpq_class(a), e));
    if (plain > 0) {
      ASSERT_FALSE(holds(plain - 1, mpq_class(a), e));
    }
  }
  EXPECT_EQ(bits_needed(0.0, 0), 0);
  EXPECT_EQ(bits_needed(1.0, 0), 0);
  EXPECT_EQ(bits_needed(536870912.0, 0), 29);
  EXPECT_EQ(bits_needed(536870913.0, 0), 30);
  EXPECT_EQ(bits_needed(-3.0, 5.0, 1.0, 0), 2);
  EXPECT_EQ(bits_needed(-4.0, 5.0, 1.0, 0), 3);
  EXPECT_EQ(bits_needed(-kMax, kMax, 0.0, 971), 53);
  EXPECT_EQ(bits_needed(kMax, kMax, -kMax, 971), 54);
  EXPECT_EQ(bits_needed(kMax, kMax, -0x1p-1074, -1074), 1024 + 1074);
}

TEST(Grid, TheCenterIsOnTheGridAndHalvesTheBits) {
  std::mt19937_64 random = seeded(kGridSeed + 2);
  for (int i = 0; i < 10000; ++i) {
    double low = i % 2 ? everyday_double(random) : random_double(random);
    double high = i % 2 ? everyday_double(random) : random_double(random);
    if (i % 3 == 0) high = std::nextafter(low, high);
    if (low > high) std::swap(low, high);
    const std::vector<double> both = {low, high};
    const int e = common_exponent(both);
    const double center = grid_center(low, high, e);
    ASSERT_EQ(mpq_class(mpq_class(center) / power_of_two(e)).get_den(), 1) << low << ' ' << high;
    const mpq_class midpoint = (mpq_class(low) + mpq_class(high)) / 2;
    const mpq_class off = abs(mpq_class(center) - midpoint);
    const mpq_class ulp = center == 0 ? mpq_class(0) : mpq_class(std::abs(center)) / power_of_two(52);
    ASSERT_LE(off, power_of_two(e) + ulp) << low << ' ' << high;
  }
  EXPECT_EQ(grid_center(1e9, 1e9 + 100, 0), 1e9 + 50);
  EXPECT_EQ(grid_center(-kMax, kMax, 971), 0);
  EXPECT_FALSE(std::signbit(grid_center(-0.0, -0.0, 0)));
  // far from the origin only the extent counts
  const double low = 1e9 + 1.0 / 3, high = low + 1;
  const std::vector<double> both = {low, high};
  const int e = common_exponent(both);
  EXPECT_LE(bits_needed(low, high, grid_center(low, high, e), e), 29);
  EXPECT_GT(bits_needed(high, e), 29);
}

mpz_class to_mpz_any(const Big& v) { return mpz_class(v.value().str()); }
template <int B>
mpz_class to_mpz_any(const Int<B>& v) {
  return to_mpz(v);
}

/// v - offset on the grid, for an offset far larger than the extent: the terms wrap around, the difference does not.
template <class C>
void check_coordinates(int bits) {
  std::mt19937_64 random = seeded(kGridSeed + 3);
  int used = 0;
  for (int i = 0; i < 20000; ++i) {
    const double offset = i % 3 == 0 ? 0.0 : everyday_double(random);
    const double near = offset + std::ldexp(static_cast<double>(random() % 1000), -20);
    const double v = i % 3 == 1 ? near : everyday_double(random);
    const std::vector<double> both = {v, offset};
    const int e = common_exponent(both) - static_cast<int>(random() % 3);
    if (bits >= 0 && bits_needed(v, v, offset, e) > bits) continue;
    ++used;
    const mpq_class expected = (mpq_class(v) - mpq_class(offset)) / power_of_two(e);
    ASSERT_EQ(to_mpz_any(grid_coordinate<C>(v, offset, e)), expected.get_num()) << v << ' ' << offset;
    if (offset == 0) {
      ASSERT_EQ(to_mpz_any(grid_coordinate<C>(v, e)), expected.get_num()) << v;
    }
  }
  EXPECT_GT(used, 1000);
}

TEST(Grid, CoordinatesOfEveryTier) {
  check_coordinates<Int<29>>(29);
  check_coordinates<Int<61>>(61);
  check_coordinates<Int<125>>(125);
  check_coordinates<Int<300>>(300);
  check_coordinates<Big>(-1);
}

TEST(Grid, CoordinatesAtTheCornersOfTheTiers) {
  EXPECT_EQ(to_mpz(grid_coordinate<Int<29>>(0x1p29, 0)), mpz_class(1) << 29);
  EXPECT_EQ(to_mpz(grid_coordinate<Int<29>>(-0x1p-1, -30)), -(mpz_class(1) << 29));
  EXPECT_EQ(to_mpz(grid_coordinate<Int<61>>(0x1p61, 0)), mpz_class(1) << 61);
  EXPECT_EQ(to_mpz(grid_coordinate<Int<125>>(-0x1p125, 0)), -(mpz_class(1) << 125));
  // both terms are multiples of 2^64, 2^128, 2^192 and vanish modulo the storage but for their difference
  EXPECT_EQ(to_mpz(grid_coordinate<Int<29>>(0x1p300 + 0x1p260, 0x1p300, 260)), 1);
  EXPECT_EQ(to_mpz(grid_coordinate<Int<29>>(0x1p52 + 3, 0x1p52, 0)), 3);
  EXPECT_EQ(to_mpz(grid_coordinate<Int<29>>(0x1p-1074, 0.0, -1074)), 1);
  EXPECT_EQ(to_mpz_any(grid_coordinate<Big>(kMax, -0x1p-1074, -1074)),
            mpz_class(mpz_class(mpq_class(kMax)) * (mpz_class(1) << 1074) + 1));
}

TEST(Grid, TiersByBitsAndByWish) {
  EXPECT_EQ(choose_tier(0, 0), Tier::b29);
  EXPECT_EQ(choose_tier(29, 29), Tier::b29);
  EXPECT_EQ(choose_tier(30, 0), Tier::b61);
  EXPECT_EQ(choose_tier(61, 0), Tier::b61);
  EXPECT_EQ(choose_tier(62, 0), Tier::b512);
  EXPECT_EQ(choose_tier(125, 0), Tier::b512);
  EXPECT_EQ(choose_tier(126, 0), Tier::arbitrary);
  EXPECT_EQ(choose_tier(3, 30), Tier::b61);
  EXPECT_EQ(choose_tier(3, 61), Tier::b61);
  EXPECT_EQ(choose_tier(3, 62), Tier::b512);
  EXPECT_EQ(choose_tier(3, 512), Tier::b512);
  EXPECT_EQ(choose_tier(3, 513), Tier::arbitrary);
  EXPECT_EQ(static_cast<int>(Tier::b29), 29);
  EXPECT_EQ(static_cast<int>(Tier::arbitrary), 0);
}

}  // namespace
}  // namespace dymsum::exact
