#include "dymsum/rational.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dymsum {
namespace {

Rational q(std::int64_t num, std::int64_t den) { return *Rational::of(num, den); }

TEST(Rational, EqualNumbersAreEqualValuesHoweverTheyWereMade) {
  EXPECT_EQ(q(-6, 4), q(3, -2));
  EXPECT_EQ(q(0, -7), Rational());
  EXPECT_EQ(q(8, 2), 4);
  EXPECT_EQ(*Rational::of(0.75), q(3, 4));
  EXPECT_EQ(*Rational::parse("1.5"), q(3, 2));
  EXPECT_NE(q(1, 3), *Rational::of(1.0 / 3));
  EXPECT_EQ(q(-6, 4).to_string(), "-3/2");
  EXPECT_EQ(Rational().to_string(), "0/1");
  EXPECT_EQ(Rational(std::numeric_limits<std::int64_t>::min()).numerator(), "-9223372036854775808");
  EXPECT_EQ(q(std::numeric_limits<std::int64_t>::min(), -1).to_string(), "9223372036854775808/1");
}

TEST(Rational, LawsOfArithmeticAndOrder) {
  for (int a = -7; a <= 7; ++a)
    for (int b = 1; b <= 5; ++b)
      for (int c = -7; c <= 7; ++c)
        for (int d = 1; d <= 5; ++d) {
          const Rational x = q(a, b), y = q(c, d);
          ASSERT_EQ(x + y, q(a * d + c * b, b * d));
          ASSERT_EQ(x - y, q(a * d - c * b, b * d));
          ASSERT_EQ(x * y, q(a * c, b * d));
          if (c != 0) {
            ASSERT_EQ(x / y, q(a * d, b * c));
          }
          ASSERT_EQ(x <=> y, a * d <=> c * b);
          ASSERT_EQ(x == y, a * d == c * b);
        }
  EXPECT_LT(q(1, 3), q(1, 2));
  EXPECT_LT(q(-1, 2), 0);
  EXPECT_GT(1, q(1, 2));
  EXPECT_EQ(-q(2, 3), q(-2, 3));
  EXPECT_EQ(q(-2, 3).sign(), -1);
  EXPECT_TRUE(q(6, 3).is_integer());
  EXPECT_FALSE(q(6, 4).is_integer());
  Rational sum;
  for (int k = 1; k <= 40; ++k) sum += q(1, k * (k + 1));
  EXPECT_EQ(sum, q(40, 41));
  sum -= q(40, 41);
  EXPECT_EQ(sum *= 3, 0);
  EXPECT_THROW((void)(q(1, 2) / sum), std::invalid_argument);
  EXPECT_THROW((void)(sum /= 0), std::invalid_argument);
}

TEST(Rational, DoublesAreTakenAtFaceValueAndGivenBack) {
  for (const double v : {0.1, -1e300, 5e-324, 0x1p-1074, 1.0, std::numeric_limits<double>::max()})
    EXPECT_EQ(Rational::of(v)->to_double(), v);
  EXPECT_EQ(q(1, 3).to_double(), 1.0 / 3);
  EXPECT_FALSE(std::signbit(Rational::of(-0.0)->to_double()));
  EXPECT_EQ((*Rational::of(1e300) * *Rational::of(1e300)).to_double(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(Rational::of(std::nan("")).error().code, ErrorCode::not_finite);
  EXPECT_EQ(Rational::of(std::numeric_limits<double>::infinity()).error().code, ErrorCode::not_finite);
}

TEST(Rational, TextIsWhatItSays) {
  EXPECT_EQ(*Rational::parse("1.01"), q(101, 100));
  EXPECT_EQ(*Rational::parse("-1e-3"), q(-1, 1000));
  EXPECT_EQ(*Rational::parse("010/08"), q(5, 4)) << "decimal, whatever the leading zeros";
  EXPECT_EQ(*Rational::parse("010"), 10);
  EXPECT_EQ(*Rational::parse("-0/5"), 0);
  EXPECT_EQ(*Rational::parse("6/-4"), q(-3, 2));
  const Rational large = *Rational::parse("-1" + std::string(30000, '0') + "/7");
  EXPECT_EQ(*Rational::parse(large.to_string()), large);
  for (const char* bad : {"", "-", "/", "1/", "/2", "0x10", "--1", " 1", "1/2/3", "1/1.5", "1/0", "one", "1e9999"})
    EXPECT_EQ(Rational::parse(bad).error().code, ErrorCode::malformed) << bad;
  EXPECT_EQ(Rational::of(1, 0).error().code, ErrorCode::malformed);
}

}  // namespace
}  // namespace dymsum
