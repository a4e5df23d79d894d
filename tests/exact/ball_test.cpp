// Balls against rationals: what they are made to contain stays inside, at every precision.
#include "exact/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dymsum::exact {
namespace {

/// A ball, and a number in it.
struct Sample {
  Ball ball;
  BigRational inside;
};

BigRational times_power(const BigRational& v, int e) {
  const BigRational power(BigInteger(BigInteger(1) << static_cast<unsigned>(std::abs(e))));
  return e < 0 ? BigRational(v / power) : BigRational(v * power);
}

Sample sample(std::mt19937_64& random, unsigned precision) {
  const auto m = static_cast<std::int64_t>(random()) >> (random() % 64);
  const std::uint64_t r = random() % 3 == 0 ? 0 : random() >> (random() % 63 + 1);
  const int e = static_cast<int>(random() % 200) - 100;
  // At an end, or anywhere.
  const auto part = static_cast<std::int64_t>(random() % 3 == 0 ? 8 : random() % 9) * (random() % 2 == 0 ? 1 : -1);
  const BigRational inside = BigRational(m) + BigRational(BigInteger(BigInteger(r) * part), 8);
  return {Ball(m, BigInteger(r), e, precision), times_power(inside, e)};
}

/// Its interval of doubles contains v, and so do its sign and top.
void expect_inside(const Ball& ball, const BigRational& v) {
  const Interval i = ball.rounded_outwards();
  EXPECT_TRUE(i.is_whole() || (exact_value(i.low()) <= v && v <= exact_value(i.high())));
  EXPECT_EQ(ball.sign().value_or(v.sign()), v.sign());
  const BigRational size = v.sign() < 0 ? BigRational(-v) : v;
  EXPECT_TRUE(v.is_zero() || size < times_power(1, static_cast<int>(ball.top())));
}

TEST(Ball, contains_what_its_numbers_make) {
  std::mt19937_64 random(21);
  int quotients = 0, signs = 0;
  for (int k = 0; k < 4000; ++k) {
    const unsigned precision = 4 + static_cast<unsigned>(random() % 90);
    const Sample a = sample(random, precision), b = sample(random, precision);
    expect_inside(a.ball, a.inside);
    expect_inside(Ball::sum(a.ball, b.ball, 1, precision), a.inside + b.inside);
    expect_inside(Ball::sum(a.ball, b.ball, -1, precision), a.inside - b.inside);
    expect_inside(Ball::product(a.ball, b.ball, precision), a.inside * b.inside);
    if (const std::optional<Ball> q = Ball::quotient(a.ball, b.ball, precision)) {
      expect_inside(*q, a.inside / b.inside);
      ++quotients;
    }
    if (a.inside.sign() >= 0) {
      const Interval root = Ball::root(a.ball, precision).rounded_outwards();
      const BigRational low = exact_value(root.low()), high = exact_value(root.high());
      EXPECT_TRUE(low <= 0 || low * low <= a.inside);
      EXPECT_TRUE(high >= 0 && high * high >= a.inside);
    }
    signs += a.ball.sign().has_value();
  }
  EXPECT_GT(quotients, 1000);
  EXPECT_GT(signs, 1000);
  EXPECT_LT(signs, 4000);
}

TEST(Ball, is_as_narrow_as_its_precision) {
  std::mt19937_64 random(22);
  for (int k = 0; k < 500; ++k) {
    const unsigned precision = 80 + static_cast<unsigned>(random() % 400);
    const Ball a(static_cast<std::int64_t>(random() >> 2) + 1, 0, 0, precision),
        b(static_cast<std::int64_t>(random() >> 40) + 1, 0, static_cast<int>(random() % 50), precision);
    const unsigned good = precision - 8;
    EXPECT_TRUE(Ball::sum(a, b, 1, precision).is_narrow(good));
    EXPECT_TRUE(Ball::product(Ball::root(a, precision), b, precision).is_narrow(good));
    EXPECT_TRUE(Ball::quotient(a, Ball::root(b, precision), precision)->is_narrow(good));
  }
}

TEST(Ball, rounds_to_the_nearest_doubles_outside) {
  const auto expect = [](const BigInteger& m, int r, std::int64_t e, double low, double high) {
    const Interval i = Ball(m, r, e, 4000).rounded_outwards();
    EXPECT_EQ(i.low(), low);
    EXPECT_EQ(i.high(), high);
  };
  const BigInteger big = BigInteger(1) << 60;
  expect(big, 0, -60, 1, 1);
  expect(big + 1, 0, -60, 1, 1 + 0x1p-52);
  expect(-big - 1, 0, -60, -1 - 0x1p-52, -1);
  expect(big, 1, -60, 1 - 0x1p-53, 1 + 0x1p-52);
  expect(1, 0, -1074, 0x1p-1074, 0x1p-1074);
  expect(3, 0, -1075, 0x1p-1074, 0x1p-1073);
  expect(-1, 0, -100000, -0x1p-1074, 0);
  expect(0, 1, -100000, -0x1p-1074, 0x1p-1074);
  expect(1, 0, 1023, 0x1p1023, 0x1p1023);
  EXPECT_TRUE(Ball(1, 0, 1024, 64).rounded_outwards().is_whole());
}

}  // namespace
}  // namespace dymsum::exact
