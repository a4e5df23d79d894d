// Exact results that are read back: the same sets, and what is none is refused.
#include "dymsum/sum_io.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "dymsum/planar_operand.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/tiny_regions.h"

namespace dymsum {
namespace {

constexpr std::uint64_t kSumSeed = 20261202;

Region region_of(const RegionData& data) { return Region::create(data).value(); }

std::string vertex(const std::string& x, const std::string& y) {
  return "{\"x_exact\":\"" + x + "\",\"y_exact\":\"" + y + "\"}";
}
std::string ring(std::initializer_list<std::string> vertices) {
  std::string text;
  for (const std::string& v : vertices) text += (text.empty() ? "" : ",") + v;
  return "{\"vertices\":[" + text + "]}";
}
std::string sum_text(const std::string& parts, const std::string& segments = "") {
  return "{\"parts\":[" + parts + "],\"segments\":[" + segments +
         "],\"points\":[],\"tight_segments\":[],\"tight_points\":[]}";
}
const std::string kTriangle = ring({vertex("0/1", "0/1"), vertex("1/3", "0/1"), vertex("0/1", "1/7")});

void refuses(const std::string& text, ErrorCode code, const std::string& words) {
  const Result<PlanarSum> read = parse_sum(text, "x.json");
  ASSERT_FALSE(read.ok()) << text.substr(0, 200);
  EXPECT_EQ(read.error().code, code) << read.error().to_string();
  EXPECT_NE(read.error().to_string().find(words), std::string::npos) << read.error().to_string();
  EXPECT_EQ(read.error().evidence.file, "x.json");
}

TEST(ReadSum, gives_back_what_was_written) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSumSeed));
  std::size_t tight = 0, thin = 0, fractions = 0;
  for (int k = 0; k < 200; ++k) {
    oracles::Random random(kSumSeed + static_cast<std::uint64_t>(k));
    const auto [p, q] = oracles::random_pair(random, 5);
    const Region a = region_of(p), b = region_of(q);
    for (const PlanarSum& sum : {minkowski_sum(a, b).value(), nfp(a, b).value()}) {
      const std::string text = sum_to_json(sum);
      const Result<PlanarSum> read = parse_sum(text, "x.json");
      ASSERT_TRUE(read.ok()) << read.error().to_string() << "\n" << text;
      EXPECT_TRUE(*read == sum);
      EXPECT_TRUE(parse_sum(sum_to_json(*read), "x.json").value() == sum);
      EXPECT_TRUE(minkowski_sum(*read, b).value() == minkowski_sum(sum, b).value());
      tight += sum.tight_points.size() + sum.tight_segments.size();
      thin += sum.points.size() + sum.segments.size();
      fractions += minkowski_sum(*read, b).value().stats.tier_bits == 0;
    }
  }
  EXPECT_GT(tight, 20u);
  EXPECT_GT(thin, 5u);
  EXPECT_GT(fractions, 20u);
}

TEST(ReadSum, names_the_vertices_of_what_it_reads) {
  const PlanarSum read = parse_sum(sum_text("{\"outer\":" + kTriangle + ",\"holes\":[]}"), "x.json").value();
  ASSERT_EQ(read.vertex_count(), 3u);
  EXPECT_EQ(read.parts[0].outer.vertices[1].out.p, 1u);
  EXPECT_EQ(read.parts[0].outer.vertices[1].in.p, 0u);
  EXPECT_EQ(read.exact(read.parts[0].outer.vertices[1]).x.to_string(), "1/3");
  EXPECT_EQ(read.area_exact().to_string(), "1/42");
  EXPECT_TRUE(parse_sum(sum_text(""), "x.json").value() == PlanarSum());
}

TEST(ReadSum, refuses_what_is_no_result) {
  const auto part = [](const std::string& outer, const std::string& holes = "") {
    return sum_text("{\"outer\":" + outer + ",\"holes\":[" + holes + "]}");
  };
  const std::string none = "the rings are none of a result";
  refuses("", ErrorCode::truncated, "");
  refuses("{\"parts\":3}", ErrorCode::malformed, "expected an array of parts");
  refuses("{\"parts\":[]}", ErrorCode::malformed, "no 'segments'");
  refuses(part(ring({vertex("0/1", "0/1"), vertex("1/1", "1/1")})), ErrorCode::malformed, "fewer than three");
  refuses(part(ring({vertex("0", "0"), vertex("2", "2"), vertex("2", "0"), vertex("0", "2")})), ErrorCode::malformed,
          none);
  refuses(part(ring({vertex("0", "0"), vertex("0", "1/7"), vertex("1/3", "0")})), ErrorCode::malformed, none);
  refuses(part(ring({vertex("1/3", "0"), vertex("0", "1/7"), vertex("0", "0")})), ErrorCode::malformed, none);
  refuses(part(ring({vertex("0", "0"), vertex("1", "0"), vertex("2", "0"), vertex("0", "1")})), ErrorCode::malformed,
          none);
  refuses(part(kTriangle, kTriangle), ErrorCode::malformed, none);
  refuses(part(ring({vertex("0/0", "0"), vertex("1", "0"), vertex("0", "1")})), ErrorCode::malformed,
          "no exact coordinate");
  refuses(part(ring({vertex("nan", "0"), vertex("1", "0"), vertex("0", "1")})), ErrorCode::malformed,
          "no exact coordinate");
  refuses(part(ring({vertex("1" + std::string(400, '0'), "0"), vertex("1", "0"), vertex("0", "1")})),
          ErrorCode::unsupported_operand, "larger than 2^1000");
  refuses(part(ring({vertex(std::string(30000, '1'), "0"), vertex("1", "0"), vertex("0", "1")})), ErrorCode::malformed,
          "30000 characters");
  refuses(sum_text("", "{\"from\":" + vertex("1", "0") + ",\"to\":" + vertex("0", "0") + "}"), ErrorCode::malformed,
          "smaller end");
  EXPECT_FALSE(begins_like_sum("{\"items\":[]}"));
  EXPECT_TRUE(begins_like_sum(" {\n \"parts\": []"));
  EXPECT_EQ(read_sum("/nowhere/x.json").error().code, ErrorCode::cannot_open);
}

}  // namespace
}  // namespace dymsum
