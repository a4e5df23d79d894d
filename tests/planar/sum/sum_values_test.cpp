// Area, equality and exact positions of hand-made sums.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "planar/position/area.h"
#include "planar/sum/listed_source.h"

namespace dymsum {
namespace {

using Q = exact::BigRational;
using planar::Position;

TEST(SumValues, CountsAndAreaOfASquareWithAHole) {
  auto source = std::make_shared<ListedSource>();
  PlanarSum sum;
  exact_source(sum) = source;
  sum.parts.push_back({source->ring({{0, 0}, {2, 0}, {2, 2}, {0, 2}}),
                       {source->ring({{Q(1, 3), Q(1, 3)}, {Q(1, 3), 1}, {1, Q(1, 3)}})}});
  EXPECT_EQ(sum.hole_count(), 1u);
  EXPECT_EQ(sum.vertex_count(), 7u);
  EXPECT_EQ(sum.area_exact().to_string(), "34/9");
  EXPECT_EQ(sum.area(), 34.0 / 9);
  EXPECT_EQ(sum.exact(sum.parts[0].holes[0].vertices[1]), (RationalPoint{*Rational::of(1, 3), *Rational::of(1, 1)}));
}

TEST(SumValues, TheEmptySum) {
  const PlanarSum empty;
  EXPECT_EQ(empty.area_exact().to_string(), "0/1");
  EXPECT_EQ(empty.area(), 0);
  EXPECT_EQ(empty.vertex_count(), 0u);
  EXPECT_EQ(empty, PlanarSum());
  EXPECT_THROW((void)empty.exact(SumVertex()), std::logic_error);
}

/// The definition, in reduced rationals.
Q area_by_definition(const std::vector<std::vector<Position>>& rings) {
  Q twice = 0;
  for (const auto& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Position& a = ring[k];
      const Position& b = ring[(k + 1) % ring.size()];
      twice += a.x * b.y - b.x * a.y;
    }
  return twice / 2;
}

TEST(SumValues, AreaEqualsTheDefinition) {
  constexpr unsigned kSeed = 20250207;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  const auto number = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(2 * limit + 1)) - limit;
  };
  int reduced = 0;
  for (int round = 0; round < 300; ++round) {
    const int den_limit = round % 3 == 0 ? 1 : round % 3 == 1 ? 12 : 1000000;
    std::vector<std::vector<Position>> rings(1 + random() % 4);
    for (auto& ring : rings) {
      ring.resize(3 + random() % 9);
      for (Position& p : ring) {
        const int den = 1 + static_cast<int>(random() % static_cast<unsigned>(den_limit));
        p = {Q(number(1000), den), Q(number(1000), random() % 4 == 0 ? 7 : den)};
      }
    }
    const Q expected = area_by_definition(rings);
    const planar::ExactArea area = planar::exact_area(rings);
    ASSERT_EQ(area.to_rational(), exact::to_rational(expected)) << "round " << round;
    ASSERT_EQ(area.to_double(), exact::round_to_double(expected)) << "round " << round;
    reduced += area.denominator > 1 && area.denominator < 1000;
  }
  EXPECT_GE(reduced, 20);
}

TEST(SumValues, AreaRoundsCorrectlyAtAllSizes) {
  for (const int exponent : {-600, -530, -40, 0, 40, 400, 511}) {
    SCOPED_TRACE(exponent);
    const Q s = power_of_two(exponent), third = s / 3;
    const std::vector<std::vector<Position>> rings{{{0, 0}, {s, 0}, {s, third}, {0, third}}};
    const Q expected = s * third;
    EXPECT_EQ(planar::exact_area(rings).to_double(), exact::round_to_double(expected));
    const std::vector<std::vector<Position>> reversed{{{0, third}, {s, third}, {s, 0}, {0, 0}}};
    EXPECT_EQ(planar::exact_area(reversed).to_double(), exact::round_to_double(-expected));
  }
}

struct EqualityTest : testing::Test {
  /// A triangle, a segment, a point, and tight ones; the last coordinate of each kind moved by the given amounts.
  static PlanarSum make(Q ring = 0, Q segment = 0, Q point = 0, Q tight_segment = 0, Q tight_point = 0) {
    auto source = std::make_shared<ListedSource>();
    source->add(77, 77);  // other numbers than in another sum do not matter
    PlanarSum sum;
    sum.parts.push_back({source->ring({{0, 0}, {1, 0}, {0, Q(1, 3) + ring}}), {}});
    sum.segments.push_back({source->add(2, 0), source->add(3, Q(1, 7) + segment)});
    sum.points.push_back(source->add(4, 4 + point));
    sum.tight_segments.push_back({source->add(5, 0), source->add(6, tight_segment)});
    sum.tight_points.push_back(source->add(7, tight_point));
    exact_source(sum) = source;
    return sum;
  }
};

TEST_F(EqualityTest, ComparesExactPositionsOfEveryKind) {
  const PlanarSum sum = make();
  const Q hair = power_of_two(-200);
  EXPECT_EQ(sum, make());
  EXPECT_NE(sum, make(hair));
  EXPECT_NE(sum, make(0, hair));
  EXPECT_NE(sum, make(0, 0, hair));
  EXPECT_NE(sum, make(0, 0, 0, hair));
  EXPECT_NE(sum, make(0, 0, 0, 0, hair));
}

TEST_F(EqualityTest, RoundedPositionsAndProvenanceDoNotMatter) {
  PlanarSum a = make();
  a.points[0].at = {100, 100};
  a.stats.crossings = 99;
  EXPECT_EQ(a, make());
}

TEST_F(EqualityTest, DifferentCountsAreUnequalWithoutAskingForPositions) {
  PlanarSum a = make(), b = make();
  b.points.clear();
  const auto& source = static_cast<const ListedSource&>(*exact_source(a));
  EXPECT_NE(a, b);
  EXPECT_EQ(source.queried, 0u);
}

TEST_F(EqualityTest, SameSourceAndProvenanceAskForNoPosition) {
  const PlanarSum a = make(), b = a;
  EXPECT_EQ(a, b);
  EXPECT_EQ(static_cast<const ListedSource&>(*exact_source(a)).queried, 0u);
}

}  // namespace
}  // namespace dymsum
