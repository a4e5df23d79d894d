// Against functions with twice as many digits: each result is the nearest double, but for ties within 2^-20 of a unit.
#include "base/elementary.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dymsum::base::elementary {

namespace {

using Long = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>>;

/// The distance of `got` from `exact` in units in the last place of `got`.
double units_off(double got, const Long& exact) {
  const double next = std::nextafter(std::fabs(got), std::numeric_limits<double>::infinity()) - std::fabs(got);
  return Long(abs(Long(got) - exact) / next).convert_to<double>();
}

constexpr double kNearest = 0.5 + 0x1p-20;

std::vector<double> numbers(double most) {
  constexpr std::uint32_t kSeed = 5;
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> even(-most, most), size(-40, std::log2(most));
  std::vector<double> all{0x1p-26, -0x1p-27, most / 2, most / 3, -most, 0x1.921fb54442d18p-1, 0x1.921fb54442d17p-1};
  for (int k = 0; k < 1500; ++k) {
    all.push_back(even(random));
    all.push_back((k % 2 == 0 ? 1 : -1) * std::exp2(size(random)));
  }
  return all;
}

template <class Mine, class Exact>
void expect_nearest(const char* name, double most, Mine mine, Exact exact) {
  double worst = 0;
  for (const double x : numbers(most)) {
    const double off = units_off(mine(x), exact(Long(x)));
    worst = std::max(worst, off);
    EXPECT_LE(off, kNearest) << name << "(" << std::hexfloat << x << ")";
  }
  std::printf("%s: at most 1/2 + 2^%.1f units off\n", name, std::log2(std::max(worst - 0.5, 0x1p-60)));
}

TEST(Elementary, ResultsAreTheNearestDoubles) {
  expect_nearest(
      "sin", 100, [](double x) { return sin(x); }, [](const Long& x) { return Long(boost::multiprecision::sin(x)); });
  expect_nearest(
      "cos", 100, [](double x) { return cos(x); }, [](const Long& x) { return Long(boost::multiprecision::cos(x)); });
  expect_nearest(
      "tan", 100, [](double x) { return tan(x); }, [](const Long& x) { return Long(boost::multiprecision::tan(x)); });
  expect_nearest(
      "sin", 0x1p29, [](double x) { return sin(x); },
      [](const Long& x) { return Long(boost::multiprecision::sin(x)); });
  expect_nearest(
      "asin", 1, [](double x) { return asin(x); }, [](const Long& x) { return Long(boost::multiprecision::asin(x)); });
  expect_nearest(
      "acos", 1, [](double x) { return acos(x); }, [](const Long& x) { return Long(boost::multiprecision::acos(x)); });
  expect_nearest(
      "atan", 1e6, [](double x) { return atan(x); },
      [](const Long& x) { return Long(boost::multiprecision::atan(x)); });
}

TEST(Elementary, ResultsOfTwoNumbersAreTheNearestDoubles) {
  const std::vector<double> all = numbers(1000);
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    const double y = all[k], x = all[k + 1];
    EXPECT_LE(units_off(atan2(y, x), Long(boost::multiprecision::atan2(Long(y), Long(x)))), kNearest) << y << " " << x;
    const Long square = Long(x) * x + Long(y) * y;
    EXPECT_LE(units_off(hypot(y, x), Long(sqrt(square))), kNearest) << y << " " << x;
  }
}

TEST(Elementary, SpecialValues) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(sin(infinity)) && std::isnan(cos(-infinity)) && std::isnan(tan(infinity)));
  EXPECT_TRUE(std::isnan(asin(1.5)) && std::isnan(acos(-1.5)));
  EXPECT_EQ(atan(infinity), std::atan(infinity));
  EXPECT_EQ(atan2(0.0, -1.0), std::atan2(0.0, -1.0));
  EXPECT_TRUE(std::signbit(sin(-0.0)) && std::signbit(tan(-0.0)) && std::signbit(asin(-0.0)) &&
              std::signbit(atan2(-0.0, 1.0)));
  EXPECT_EQ(cos(0.0), 1.0);
  EXPECT_EQ(hypot(0x1p1000, 0x1p1000), std::hypot(0x1p1000, 0x1p1000));
  EXPECT_EQ(hypot(3 * 0x1p-1070, 4 * 0x1p-1070), 5 * 0x1p-1070);
}

}  // namespace
}  // namespace dymsum::base::elementary
