// Orientations of angles of any size, against the sines and cosines of the C library, which reduces them on its own.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "dymsum/orientation.h"
#include "exact/big.h"

namespace dymsum {
namespace {

struct Position {
  double cosine = 1, sine = 0;
};

Position position_of(const Orientation& o) {
  if (o.is_half_turn()) return {-1, 0};
  const exact::BigRational t = exact::exact_value(o.tan_half()), t2 = t * t;
  return {exact::round_to_double(exact::BigRational((1 - t2) / (1 + t2))),
          exact::round_to_double(exact::BigRational(2 * t / (1 + t2)))};
}

// Angles near 0 differ as much as their points on the circle.
void expect_met(double radians, const Orientation& o, double error) {
  const Position at = position_of(o);
  EXPECT_LE(std::hypot(at.cosine - std::cos(radians), at.sine - std::sin(radians)), error + 0x1p-51) << radians;
  EXPECT_GT(o.radians(), -std::numbers::pi);
  EXPECT_LE(o.radians(), std::numbers::pi);
}

TEST(Orientation, meets_angles_of_any_size) {
  std::mt19937_64 random(1);
  std::vector<double> angles{1e6,
                             1e16,
                             1e22,
                             1e300,
                             5.319372648326541e255,
                             std::numeric_limits<double>::max(),
                             4,
                             2 * std::numbers::pi + 1e-9};
  for (int k = 0; k < 2000; ++k)
    angles.push_back(std::ldexp(1 + static_cast<double>(random() % 1000000) / 1e6, static_cast<int>(random() % 1023)));
  for (const double angle : angles)
    for (const double radians : {angle, -angle}) {
      expect_met(radians, *Orientation::nearest(radians), 0x1p-50);
      for (const double error : {1e-3, 1e-9, 0x1p-47})
        expect_met(radians, *Orientation::nearest(radians, error), error);
    }
}

TEST(Orientation, meets_multiples_of_quarter_turns_exactly_near_the_origin) {
  for (int k = -9; k <= 9; ++k) {
    const Orientation expected = k % 4 == 0   ? Orientation{}
                                 : k % 2 == 0 ? Orientation::half_turn()
                                              : *Orientation::of((k % 4 + 4) % 4 == 1 ? 1 : -1, 1);
    EXPECT_EQ(*Orientation::nearest(k * std::numbers::pi / 2), expected) << k;
  }
  // Up to half a turn a double is what it says.
  EXPECT_NE(*Orientation::nearest(1e-17), Orientation{});
  EXPECT_NE(*Orientation::nearest(std::nextafter(std::numbers::pi, 0)), Orientation::half_turn());
  EXPECT_NE(*Orientation::nearest(std::nextafter(std::numbers::pi / 2, 4)), *Orientation::of(1, 1));
}

// Turning three times by a third is turning by the whole.
TEST(Orientation, meets_shares_of_long_turns) {
  for (const double radians : {1.0, 7.0, 1e9, 1e12, 1e15, 1e16 + 2, 1e20, 1e22, 1e300}) {
    const double third = reduced_radians(*Rational::of(radians) / 3);
    EXPECT_LE(std::abs(third), std::numbers::pi) << radians;
    const Orientation turn = *Orientation::nearest(third);
    expect_met(radians, turn * turn * turn, 3 * Orientation::kAngularError);
    expect_met(-radians, (turn * turn * turn).inverse(), 3 * Orientation::kAngularError);
    EXPECT_EQ(reduced_radians(-*Rational::of(radians) / 3), -third);
    EXPECT_EQ(*Orientation::nearest(reduced_radians(*Rational::of(radians))), *Orientation::nearest(radians));
  }
  EXPECT_THROW(reduced_radians(*Rational::of(1e308) * Rational(1000)), std::invalid_argument);
}

TEST(Orientation, degrees_of_any_size_are_reduced_exactly) {
  constexpr double kPi = std::numbers::pi;
  for (const char* const turns : {"0/1", "1/1", "-1/1", "1000000000000/1", "-123456789012345678901234567890/1"}) {
    const Rational whole = *Rational::parse(turns) * 360;
    EXPECT_EQ(reduced_degrees(whole), 0);
    EXPECT_EQ(reduced_degrees(whole + 90), kPi / 2);
    EXPECT_EQ(reduced_degrees(whole + 180), kPi);
    EXPECT_EQ(reduced_degrees(whole - 180), kPi);
    EXPECT_EQ(reduced_degrees(whole + 270), -kPi / 2);
    for (const int degrees : {-179, -91, -30, 1, 60, 89, 100, 179})
      EXPECT_NEAR(reduced_degrees(whole + Rational(degrees)), degrees / 180.0 * kPi, 0x1p-50) << turns;
    EXPECT_NEAR(reduced_degrees(whole + *Rational::of(1, 3)), kPi / 540, 0x1p-55) << turns;
    EXPECT_EQ(reduced_degrees(whole + *Rational::parse("1e-30") - 180), kPi) << turns;
  }
}

TEST(Orientation, an_error_that_cannot_be_promised_is_refused) {
  constexpr double kLeast = Orientation::kAngularError;
  expect_met(1, *Orientation::nearest(1, kLeast), kLeast);
  for (const double error : {std::nextafter(kLeast, 0), 1e-18, 1e-300, 0.0, -1.0, std::nan("")}) {
    const Result<Orientation> met = Orientation::nearest(1, error);
    ASSERT_FALSE(met.ok()) << error;
    EXPECT_EQ(met.error().code, ErrorCode::bad_rotation);
    EXPECT_NE(met.error().message.find("2^-50"), std::string::npos);
  }
}

}  // namespace
}  // namespace dymsum
