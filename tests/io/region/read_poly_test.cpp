#include <limits>

#include "io/reading.h"

namespace dymsum::io_test {
namespace {

constexpr RegionFormat kPoly = RegionFormat::poly;

Evidence refused_poly(std::string_view text, ErrorCode code, std::int64_t line, std::string_view words) {
  return expect_refused(text, kPoly, code, line, words);
}

TEST(ReadPoly, an_in_chain_is_a_hole_of_the_last_out_chain) {
  const RegionData data = read_one(
      "4\n"
      "3 out\n0 0\n9 0\n0 9\n1 2 3\n"
      "3 in\n1 1\n1 2\n2 1\n1 2 3\n"
      "3 out\n20 0\n29 0\n20 9\n1 2 3\n"
      "3 in\n21 1\n21 2\n22 1\n1 2 3\n",
      kPoly);
  const Part first{{{0, 0}, {9, 0}, {0, 9}}, {{{1, 1}, {1, 2}, {2, 1}}}};
  const Part second{{{20, 0}, {29, 0}, {20, 9}}, {{{21, 1}, {21, 2}, {22, 1}}}};
  EXPECT_EQ(data, (RegionData{{first, second}, {}, {}}));
}

TEST(ReadPoly, glued_numbers_split_at_the_second_decimal_point) {
  const RegionData data = read_one("1\n3 out\n-6.64248.788605\n7.84688.042924\n1.5e1.25\n", kPoly);
  EXPECT_EQ(data.parts.at(0).outer, (Ring{{-6.64248, .788605}, {7.84688, .042924}, {15, .25}}));
}

TEST(ReadPoly, comments_blank_lines_tabs_and_carriage_returns_are_skipped) {
  const RegionData plain = read_one("1\n3 out\n0 0\n1 0\n0 1\n1 2 3\n", kPoly);
  EXPECT_EQ(
      read_one("# head\r\n\r\n1 # one\r\n\t3   out#kind\r\n0\t0\r\n1 0 # x y\r\n  0 1\r\n#c\r\n1 2 3 #end\r\n\r\n",
               kPoly),
      plain);
  EXPECT_EQ(read_one("\xEF\xBB\xBF"
                     "1 3 out 0 0 1 0 0 1",
                     kPoly),
            plain);
}

TEST(ReadPoly, the_index_line_orders_the_points) {
  EXPECT_EQ(read_one("1\n3 out\n0 0\n0 1\n1 0\n1 3 2\n", kPoly).parts.at(0).outer, (Ring{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(ReadPoly, the_index_line_may_be_missing) {
  const RegionData data = read_one("2\n3 out\n0 0\n1 0\n0 1\n3 out\n5 5\n6 5\n5 6", kPoly);
  ASSERT_EQ(data.parts.size(), 2u);
  EXPECT_EQ(data.parts[1].outer, (Ring{{5, 5}, {6, 5}, {5, 6}}));
}

TEST(ReadPoly, polylines_and_points_are_chains_of_their_own_kinds) {
  const RegionData data = read_one("2\n2 open\n0 0\n1 1\n1 2\n2 points\n3 3\n4 4\n1 2\n", kPoly);
  EXPECT_EQ(data, (RegionData{{}, {{{0, 0}, {1, 1}}}, {{3, 3}, {4, 4}}}));
  EXPECT_EQ(read_one("0\n", kPoly), RegionData{});
}

TEST(ReadPoly, no_chain_is_checked_or_mended) {
  const RegionData data = read_one("2\n0 out\n3 out\n0 0\n0 0\n0 0\n", kPoly);
  EXPECT_EQ(data.parts.at(0).outer.size(), 0u);
  EXPECT_EQ(data.parts.at(1).outer, (Ring{{0, 0}, {0, 0}, {0, 0}}));
}

TEST(ReadPoly, numbers_are_the_nearest_doubles) {
  const RegionData data = read_one("1\n3 points\n+0.1 1e-400\n1.7976931348623157e308 5e-324\n-.5 5.\n", kPoly);
  EXPECT_EQ(data.points, (std::vector<Point>{{0.1, 0}, {std::numeric_limits<double>::max(), 5e-324}, {-0.5, 5}}));
}

TEST(ReadPoly, refuses_text_that_is_no_poly_file) {
  refused_poly("hello\n", ErrorCode::malformed, 1, "the number of chains instead of 'hello'");
  refused_poly("1\nthree out\n", ErrorCode::malformed, 2, "number of points");
  refused_poly("1\n-3 out\n", ErrorCode::malformed, 2, "'-3'");
  refused_poly("1\n3 around\n0 0\n", ErrorCode::malformed, 2, "'around'");
  refused_poly("1\n3 in\n0 0\n1 0\n0 1\n", ErrorCode::malformed, 2, "without an 'out' chain");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2 3\nmore\n", ErrorCode::malformed, 7, "after the last chain");
}

TEST(ReadPoly, a_bad_coordinate_is_named_with_chain_vertex_and_line) {
  const Evidence bad = refused_poly("2\n3 out\n0 0\n1 0\n0 1\n3 in\n0 0\n1 0x\n0 1\n", ErrorCode::malformed, 8, "'0x'");
  EXPECT_EQ(bad.part, 0);
  EXPECT_EQ(bad.ring, 1);
  EXPECT_EQ(bad.vertex, 1);
  refused_poly("1\n3 out\n0 0\n1,0\n", ErrorCode::malformed, 4, "'1,0'");
  refused_poly("1\n3 out\n0 0\n1 1.5.\n", ErrorCode::malformed, 4, "'1.5.'");
  refused_poly("1\n3 out\n0 0\n1 5-2\n", ErrorCode::malformed, 4, "'5-2'");
}

TEST(ReadPoly, coordinates_must_be_finite) {
  for (const char* bad : {"nan", "inf", "-inf", "NAN", "1e999", "-1e999", "1e99999999999999999999"}) {
    const Evidence evidence =
        refused_poly("1\n3 out\n0 0\n1 " + std::string(bad) + "\n0 1\n", ErrorCode::not_finite, 4, bad);
    EXPECT_EQ(evidence.vertex, 1);
  }
  refused_poly("1\n1 points\n0 " + std::string(400, '9') + "e-50\n", ErrorCode::not_finite, 3, "finite");
}

TEST(ReadPoly, an_index_line_must_be_a_permutation) {
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2 2\n", ErrorCode::malformed, 6, "2 comes twice");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n0 1 2\n", ErrorCode::malformed, 6, "0 is outside");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2 4\n", ErrorCode::malformed, 6, "4 is outside");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2 3 1\n", ErrorCode::malformed, 6, "comes twice");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2.5 3\n", ErrorCode::malformed, 6, "'2.5'");
  refused_poly("2\n3 out\n0 0\n1 0\n0 1\n1 2\n3 out\n0 0\n1 0\n0 1\n", ErrorCode::malformed, 6,
               "2 numbers for 3 points");
}

TEST(ReadPoly, a_file_that_ends_early_is_truncated) {
  refused_poly("", ErrorCode::truncated, 1, "ends before the number of chains");
  refused_poly("# only a comment\n\n", ErrorCode::truncated, 1, "ends before the number of chains");
  refused_poly("2\n3 out\n0 0\n1 0\n0 1\n1 2 3\n", ErrorCode::truncated, 6, "announces 2 chains and ends after 1");
  refused_poly("1\n3", ErrorCode::truncated, 2, "the kind");
  refused_poly("1\n3 out\n0 0\n1", ErrorCode::truncated, 4, "3 points");
  refused_poly("1\n3 out\n0 0\n1 0\n0 1\n1 2", ErrorCode::truncated, 6, "2 numbers for 3 points");
}

TEST(ReadPoly, huge_announced_counts_allocate_nothing) {
  refused_poly("1\n18446744073709551615 out\n0 0\n", ErrorCode::truncated, 3, "ends before them");
  refused_poly("1\n99999999999999999999999999 out\n0 0\n", ErrorCode::truncated, 3, "ends before them");
  refused_poly("18446744073709551615\n3 out\n0 0\n1 0\n0 1\n1 2 3\n", ErrorCode::truncated, 6, "ends after 1");
}

TEST(ReadPoly, the_index_may_go_on_on_further_lines) {
  const RegionData one_line = read_one("2\n4 out\n0 0\n1 0\n1 1\n0 1\n1 2 3 4\n3 out\n5 5\n6 5\n5 6\n1 2 3\n", kPoly);
  EXPECT_EQ(read_one("2\n4 out\n0 0\n1 0\n1 1\n0 1\n1 2\n3 4\n3 out\n5 5\n6 5\n5 6\n1\n2\n# the last\n3\n", kPoly),
            one_line);
  refused_poly("2\n4 out\n0 0\n1 0\n1 1\n0 1\n1 2\n3\n3 out\n5 5\n6 5\n5 6\n", ErrorCode::malformed, 7,
               "3 numbers for 4 points");
  refused_poly("1\n4 out\n0 0\n1 0\n1 1\n0 1\n1 2\n2 4\n", ErrorCode::malformed, 7, "2 comes twice");
  refused_poly("1\n4 out\n0 0\n1 0\n1 1\n0 1\n1 2\n3\n", ErrorCode::truncated, 7, "3 numbers for 4 points");
}

}  // namespace
}  // namespace dymsum::io_test
