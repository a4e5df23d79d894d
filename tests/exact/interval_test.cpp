// Intervals of doubles against exact arithmetic: they contain what they stand for, and are points where they can be.
#include "exact/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace dymsum::exact {
namespace {

bool holds(const Interval& i, const BigRational& v) {
  return i.is_whole() || (exact_value(i.low()) <= v && v <= exact_value(i.high()));
}
bool holds_root(const Interval& i, const BigRational& v) {
  if (i.is_whole()) return true;
  const BigRational low = exact_value(i.low()), high = exact_value(i.high());
  return low >= 0 && low * low <= v && v <= high * high;
}

/// Finite doubles of all sizes, many of them at the ends of the range, next to powers of two or small integers.
double any_double(std::mt19937_64& random) {
  const double m = static_cast<double>(static_cast<std::int64_t>(random()) >> (random() % 64));
  switch (random() % 6) {
    case 0:
      return std::ldexp(m, static_cast<int>(random() % 1990) - 1040);
    case 1:
      return std::ldexp(m, static_cast<int>(random() % 40) - 1100);
    case 2:
      return std::ldexp(m, static_cast<int>(random() % 12) + 950);
    case 3:
      return std::nextafter(std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000), random() % 2 == 0 ? 0 : 1e308);
    case 4:
      return static_cast<double>(random() % 2001) - 1000;
    default:
      return std::ldexp(m, -30);
  }
}

TEST(Interval, contains_what_points_make) {
  std::mt19937_64 random(11);
  int whole = 0, points = 0;
  for (int k = 0; k < 20000; ++k) {
    const double x = any_double(random), y = k % 7 == 0 ? -x : any_double(random);
    ASSERT_TRUE(std::isfinite(x) && std::isfinite(y));
    const Interval a(x), b(y);
    const BigRational p = exact_value(x), q = exact_value(y);
    EXPECT_TRUE(holds(a + b, p + q)) << x << ' ' << y;
    EXPECT_TRUE(holds(a - b, p - q)) << x << ' ' << y;
    EXPECT_TRUE(holds(a * b, p * q)) << x << ' ' << y;
    if (y != 0) {
      EXPECT_TRUE(holds(a / b, p / q)) << x << ' ' << y;
    }
    if (y == 0) {
      EXPECT_TRUE((a / b).is_whole());
    }
    if (x >= 0) {
      EXPECT_TRUE(holds_root(sqrt(a), p)) << x;
    }
    if (x < 0) {
      EXPECT_TRUE(sqrt(a).is_whole());
    }
    whole += (a * b).is_whole();
    points += (a + b).is_point() && (a * b).is_point();
  }
  EXPECT_GT(whole, 100);
  EXPECT_LT(whole, 10000);
  EXPECT_GT(points, 500);
}

TEST(Interval, contains_what_its_numbers_make) {
  std::mt19937_64 random(12);
  for (int k = 0; k < 3000; ++k) {
    const double x = any_double(random), y = any_double(random), s = any_double(random), t = any_double(random);
    const Interval a(std::min(x, y), std::max(x, y)), b(std::min(s, t), std::max(s, t));
    for (const double u : {x, y, x / 2 + y / 2}) {
      const BigRational p = exact_value(u);
      EXPECT_TRUE(holds(square(a), p * p));
      EXPECT_TRUE(holds(-a, -p));
      if (u >= 0) {
        EXPECT_TRUE(holds_root(sqrt(a), p));
      }
      for (const double v : {s, t, s / 2 + t / 2}) {
        const BigRational q = exact_value(v);
        EXPECT_TRUE(holds(a + b, p + q) && holds(a - b, p - q) && holds(a * b, p * q)) << u << ' ' << v;
        if (v != 0) {
          EXPECT_TRUE(holds(a / b, p / q)) << u << ' ' << v;
        }
      }
    }
    EXPECT_TRUE(!b.contains_zero() || (a / b).is_whole());
  }
}

TEST(Interval, is_a_point_where_doubles_are_exact) {
  const Interval a(3), b(4), c(-7);
  EXPECT_EQ(sign_of(a * b + c * Interval(2) + Interval(2)), 0);
  EXPECT_EQ(sqrt(a * a + b * b).low(), 5);
  EXPECT_TRUE(sqrt(a * a + b * b).is_point());
  EXPECT_TRUE((b / Interval(8)).is_point());
  EXPECT_FALSE((a / c).is_point());
  EXPECT_FALSE(sqrt(a).is_point());
  EXPECT_EQ(sign_of(sqrt(a) * sqrt(a) - a), std::nullopt);
  EXPECT_EQ(sign_of(sqrt(a) - Interval(2)), -1);
  EXPECT_EQ(sign_of(sqrt(a) - Interval(1.7)), 1);
}

TEST(Interval, of_integers) {
  std::mt19937_64 random(13);
  for (int bits = 1; bits < 1100; ++bits) {
    BigInteger v = 1;
    for (int k = 0; k < bits; ++k) v = 2 * v + (random() % 8 != 0 ? 1 : 0);
    EXPECT_TRUE(holds(Interval(v), BigRational(v))) << bits;
    EXPECT_TRUE(holds(Interval(BigInteger(-v)), BigRational(BigInteger(-v)))) << bits;
    EXPECT_EQ(Interval(v).is_whole(), bits >= 1024) << bits;
  }
  for (const std::int64_t v : {std::int64_t{1} << 53, (std::int64_t{1} << 53) + 1, -(std::int64_t{1} << 53) - 1,
                               std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_TRUE(holds(Interval(v), BigRational(BigInteger(v)))) << v;
    EXPECT_TRUE(holds(Interval(BigInteger(v)), BigRational(BigInteger(v)))) << v;
  }
  EXPECT_TRUE(Interval(BigInteger(BigInteger(5) << 900)).is_point());
  EXPECT_TRUE(holds(Interval(BigRational(-1, 3)), BigRational(-1, 3)));
}

TEST(Interval, what_is_no_number_is_the_whole_line) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Interval most(std::numeric_limits<double>::max());
  for (const Interval& i : {Interval(infinity), Interval(std::nan("")), Interval(1, infinity), Interval(2, 1),
                            most + most, most * most, most / Interval(0x1p-1074), sqrt(Interval::whole()),
                            Interval::whole() * Interval(0), Interval::whole() - Interval::whole()}) {
    EXPECT_TRUE(i.is_whole());
    EXPECT_EQ(sign_of(i), std::nullopt);
    EXPECT_TRUE(i.contains(1e300) && i.contains(-1e300));
  }
}

}  // namespace
}  // namespace dymsum::exact
