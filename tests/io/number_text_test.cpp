#include "io/source.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace dymsum::io {
namespace {

std::string shortest(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string rounded(double value, int decimals) {
  std::string text;
  append_rounded(text, value, decimals);
  return text;
}

TEST(NumberText, the_shortest_text_reads_back_to_the_same_double) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-3), "-3");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(1e22), "1e+22");
  EXPECT_EQ(shortest(5e-324), "5e-324");
  constexpr std::uint64_t kSeed = 20260101;
  std::mt19937_64 random(kSeed);
  int finite = 0;
  for (int k = 0; k < 100000; ++k) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    ++finite;
    const std::string text = shortest(value);
    const ScannedNumber number = scan_number(text);
    ASSERT_EQ(number.length, text.size()) << text << ", seed " << kSeed;
    ASSERT_EQ(number.value, value) << text << ", seed " << kSeed;
  }
  EXPECT_GT(finite, 99000);
}

TEST(NumberText, a_number_ends_where_it_ends) {
  EXPECT_EQ(scan_number("1.5.25").length, 3u);
  EXPECT_EQ(scan_number("7e").length, 1u);
  EXPECT_EQ(scan_number("+2 ").length, 2u);
  EXPECT_EQ(scan_number("0x10").length, 1u);
  for (const char* none : {"", "x", "+", "-", ".", "+-1", "++1", "+inf", " 1"})
    EXPECT_EQ(scan_number(none).length, 0u) << none;
}

TEST(NumberText, past_the_double_range_is_infinite_and_below_it_is_zero) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scan_number("1e309").value, inf);
  EXPECT_EQ(scan_number("-1e309").value, -inf);
  EXPECT_EQ(scan_number("1" + std::string(400, '0')).value, inf);
  EXPECT_EQ(scan_number(std::string(500, '9') + "e-100").value, inf);
  EXPECT_EQ(scan_number("0." + std::string(50, '0') + "1e999").value, inf);
  EXPECT_EQ(scan_number("1e99999999999999999999999").value, inf);
  EXPECT_EQ(scan_number("1e-400").value, 0);
  EXPECT_EQ(scan_number("-0." + std::string(400, '0') + "1").value, 0);
  EXPECT_EQ(scan_number("100e-99999999999999999999999").value, 0);
  EXPECT_EQ(scan_number("0." + std::string(500, '0') + "1e+50").value, 0);
  EXPECT_EQ(scan_number("1e-400").length, 6u);
}

TEST(NumberText, counts_saturate) {
  EXPECT_EQ(scan_count("17 out").value, 17u);
  EXPECT_EQ(scan_count("17 out").length, 2u);
  EXPECT_EQ(scan_count("99999999999999999999").value, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(scan_count("99999999999999999999").length, 20u);
  EXPECT_EQ(scan_count("-1").length, 0u);
}

TEST(NumberText, numbers_for_pictures_are_short) {
  EXPECT_EQ(rounded(1.0, 2), "1");
  EXPECT_EQ(rounded(1.256, 2), "1.26");
  EXPECT_EQ(rounded(-0.001, 2), "0");
  EXPECT_EQ(rounded(120, 0), "120");
  EXPECT_EQ(rounded(std::numeric_limits<double>::infinity(), 2), "0");
  EXPECT_EQ(with_commas(16425), "16,425");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1000000), "1,000,000");
}

}  // namespace
}  // namespace dymsum::io
