// One small text file per hard case (tests/corpus/planar): the facts it states hold for every engine, and the sum by
// definition agrees.
#include <gtest/gtest.h>

#include "oracles/exact_shape.h"
#include "oracles/pair_text.h"
#include "oracles/verdict.h"

namespace dymsum::oracles {
namespace {

std::vector<Pt<Big>> points_of(const std::string& wkt) {
  std::vector<Pt<Big>> out;
  for (const Point& c : parse_wkt(wkt).points) out.push_back({from_double<Big>(c.x), from_double<Big>(c.y)});
  return out;
}

std::vector<Seg<Big>> segments_of(const std::string& wkt) {
  std::vector<Seg<Big>> out;
  for (const Polyline& line : parse_wkt(wkt).polylines)
    out.push_back({{from_double<Big>(line[0].x), from_double<Big>(line[0].y)},
                   {from_double<Big>(line[1].x), from_double<Big>(line[1].y)}});
  return out;
}

Result<PlanarSum> compute(const Case& one, const Region& p, const Region& q, const SumOptions& options) {
  if (one.op == "nfp") return nfp(p, q, options);
  if (one.op == "erode") return erode(p, q, options);
  EXPECT_EQ(one.op, "sum");
  return minkowski_sum(p, q, options);
}

void expect_fact(const PlanarSum& sum, const std::string& key, const std::string& value) {
  const ExactShape<Big> shape = exact_shape<Big>(sum);
  if (key == "parts") EXPECT_EQ(std::to_string(sum.parts.size()), value);
  else if (key == "holes") EXPECT_EQ(std::to_string(sum.hole_count()), value);
  else if (key == "vertices") EXPECT_EQ(std::to_string(sum.vertex_count()), value);
  else if (key == "area") EXPECT_EQ(sum.area_exact().to_string(), value);
  else if (key == "points") EXPECT_TRUE(shape.points == points_of(value));
  else if (key == "tight_points") EXPECT_TRUE(shape.tight_points == points_of(value));
  else if (key == "segments") EXPECT_TRUE(shape.segments == segments_of(value));
  else if (key == "tight_segments") EXPECT_TRUE(shape.tight_segments == segments_of(value));
  else ADD_FAILURE() << "unknown fact " << key;
}

class SumCorpus : public ::testing::TestWithParam<Case> {};

TEST_P(SumCorpus, stated_facts_hold_in_every_engine) {
  const Case& one = GetParam();
  const Region p = Region::create(one.p).value(), q = Region::create(one.q).value();
  for (const Engine engine : {Engine::fast, Engine::brute, Engine::winding}) {
    SumOptions options;
    options.engine = engine;
    const Result<PlanarSum> sum = compute(one, p, q, options);
    ASSERT_TRUE(sum.ok()) << sum.error().to_string();
    for (const auto& [key, value] : one.expect) {
      SCOPED_TRACE("expect " + key + " " + value + ", engine " + std::to_string(static_cast<int>(engine)));
      expect_fact(*sum, key, value);
    }
  }
}

TEST_P(SumCorpus, sum_by_definition_agrees) { EXPECT_EQ(verdict(GetParam().p, GetParam().q), ""); }

INSTANTIATE_TEST_SUITE_P(Files, SumCorpus, ::testing::ValuesIn(read_cases(DYMSUM_CORPUS_DIR "/planar")),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dymsum::oracles
