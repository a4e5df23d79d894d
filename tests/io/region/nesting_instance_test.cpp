// Whole nesting instances, and what is wrong with those that are refused.
#include "dymsum/nesting.h"

#include <gtest/gtest.h>

#include "fuzz/text_lines.h"
#include "io/damage.h"
#include "io/refusal.h"

namespace dymsum {
namespace {

using io_test::expect_refusal;
using io_test::kRefusedFile;

constexpr const char* kShape = R"("shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]})";

std::string item(const std::string& more) { return "{" + std::string(kShape) + more + "}"; }
std::string instance(const std::string& items, const std::string& more = "") {
  return R"({"items":[)" + items + "]" + more + "}";
}

void refused(const std::string& text, std::string_view words, std::int64_t line = 1,
             ErrorCode code = ErrorCode::malformed) {
  expect_refusal(parse_nesting_instance(text, kRefusedFile), text, code, line, words);
}

TEST(NestingInstance, rings_that_are_closed_are_those_that_are_not) {
  const auto shape = [](const std::string& type, const std::string& data) {
    const std::string text = R"({"items":[{"shape":{"type":")" + type + R"(","data":)" + data + "}}]}";
    return Region::create(parse_nesting_instance(text, "test").value().items.at(0).shape).value();
  };
  EXPECT_EQ(shape("simple_polygon", "[[0,0],[4,0],[0,4],[0,0]]"), shape("simple_polygon", "[[0,0],[4,0],[0,4]]"));
  EXPECT_EQ(shape("polygon", R"({"outer":[[0,0],[4,0],[0,4],[0,0]],"inner":[[[1,1],[1,2],[2,1],[1,1]]]})"),
            shape("polygon", R"({"outer":[[0,0],[4,0],[0,4]],"inner":[[[1,1],[1,2],[2,1]]]})"));
}

TEST(NestingInstance, holds_everything) {
  const NestingInstance read =
      parse_nesting_instance(
          instance(item(R"(,"id":"a","demand":3,"allowed_orientations":[0.0,180.0])") + "," +
                       item(R"(,"id":7,"allowed_orientations":[0.1])") + "," +
                       item(R"(,"allowed_orientations":[0,90,180,-90.5])"),
                   R"(,"name":"test","strip_height":40.5,"bins":[{)" + std::string(kShape) + R"(,"stock":1}])"),
          "test")
          .value();
  EXPECT_EQ(read.name, "test");
  ASSERT_EQ(read.items.size(), 3u);
  EXPECT_EQ(read.items[0].name, "a");
  EXPECT_EQ(read.items[0].demand, 3u);
  EXPECT_EQ(*read.items[0].degrees, (std::vector<Rational>{0, 180}));
  EXPECT_EQ(read.items[1].name, "7");
  EXPECT_EQ(read.items[1].demand, 1u);
  EXPECT_EQ(*read.items[1].degrees, std::vector<Rational>{Rational::of(1, 10).value()}) << "the decimal number itself";
  EXPECT_EQ(read.items[2].name, "2");
  EXPECT_EQ(read.items[2].degrees->back(), Rational::of(-181, 2).value());
  ASSERT_EQ(read.bins.size(), 1u);
  EXPECT_EQ(read.bins[0].name, "0");
  EXPECT_EQ(read.strip_height, 40.5);
  EXPECT_EQ(read.items[0].shape.parts.at(0).outer.size(), 3u);
}

TEST(NestingInstance, any_orientation) {
  EXPECT_FALSE(parse_nesting_instance(instance(item("")), "test").value().items[0].degrees.has_value());
  EXPECT_FALSE(parse_nesting_instance(instance(item(R"(,"allowed_orientations":null)")), "test")
                   .value()
                   .items[0]
                   .degrees.has_value());
}

TEST(NestingInstance, what_is_wrong_is_told) {
  refused("[1,2]", "'items'");
  refused("{}", "'items'");
  refused(R"({"items":3})", "items");
  refused(R"({"items":[3]})", "'shape'");
  refused(instance("{}"), "'shape'");
  refused(instance(item(R"(,"demand":-1)")), "count");
  refused(instance(item(R"(,"demand":1.5)")), "count");
  refused(instance(item(R"(,"demand":1e300)")), "count");
  refused(instance(item(R"(,"demand":"3")")), "number");
  refused(instance(item(R"(,"allowed_orientations":[])")), "no orientation");
  refused(instance(item(R"(,"allowed_orientations":90)")), "orientations");
  refused(instance(item(R"(,"allowed_orientations":["90"])")), "degrees");
  refused(instance(item(R"(,"allowed_orientations":[[0,90]])")), "degrees");
  refused(instance("\n" + item("") + ",\n" + item(R"(,"allowed_orientations":[1e999])")), "", 3, ErrorCode::not_finite);
  refused(instance(item(""), R"(,"strip_height":0)"), "positive");
  refused(instance(item(""), R"(,"strip_height":-2)"), "positive");
  refused(instance(item(""), R"(,"strip_height":[1,2])"), "number");
  refused(instance(item(R"(,"id":"a")") + "," + item(R"(,"id":"a")")), "two items are named 'a'");
  refused(instance(item(R"(,"id":"1")") + "," + item("")), "two items are named '1'");
  refused(instance(item(""), R"(,"bins":[{}])"), "'shape'");
  refused(instance(item(""), R"(,"bins":[{)" + std::string(kShape) + R"(,"zones":[{}]}])"), "zones");
  refused("", "", 1, ErrorCode::truncated);
  refused(instance(item("")).substr(0, 30), "", 1, ErrorCode::truncated);
  EXPECT_EQ(read_nesting_instance("/nowhere/at.json").error().code, ErrorCode::cannot_open);
}

// Damaged texts: an error with its line, or an instance.
TEST(NestingInstance, damage_is_told) {
  const std::string whole =
      instance("\n" + item(R"(,"id":"a","demand":3,"allowed_orientations":[0.0,180.0])") + ",\n" +
                   item(R"(,"allowed_orientations":[0,90.5,180])"),
               R"(,"name":"test","strip_height":40.5,"bins":[{)" + std::string(kShape) + R"(,"zones":[]}])");
  const std::vector<std::string> words = {"NaN", "1e999", "-1",   "[",  "]",     "{", "}",
                                          "\"",  ",",     "null", "\n", "1e300", ""};
  int good = 0, bad = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const std::string text = io_test::Damage(seed, words)(whole, whole);
    const Result<NestingInstance> read = parse_nesting_instance(text, "damaged");
    ++(read ? good : bad);
    if (read) continue;
    ASSERT_EQ(read.error().evidence.file, "damaged") << text;
    ASSERT_TRUE(read.error().evidence.line.has_value()) << text;
    ASSERT_LE(*read.error().evidence.line, fuzz::most_lines(text)) << text;
  }
  EXPECT_GT(good, 100);
  EXPECT_GT(bad, 500);
}

}  // namespace
}  // namespace dymsum
