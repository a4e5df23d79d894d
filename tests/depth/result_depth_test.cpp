// The depth of results whose vertices are fractions is that of the same solids in integers, divided by the scale.
#include <gtest/gtest.h>

#include "dymsum/penetration_depth.h"
#include "dymsum/solids.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/scaled_solid.h"

namespace dymsum::oracles {
namespace {

using exact::BigInteger;
using exact::BigRational;

Rational quotient(const Rational& a, const BigInteger& by) {
  return exact::to_rational(BigRational(exact::exact_value(a) / by));
}
RationalPoint3 quotient(const RationalPoint3& a, const BigInteger& by) {
  return {quotient(a.x, by), quotient(a.y, by), quotient(a.z, by)};
}

TEST(ResultDepth, IsThatOfTheSolidInIntegers) {
  Random random(2041);
  int overlapping = 0, apart = 0, touching = 0;
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE(round);
    const SpatialSum p = random_solid_of_fractions(random), q = random_solid_of_fractions(random);
    const BigInteger scale = lcm(denominator_of(p), denominator_of(q));
    const std::optional<Mesh> p_whole = solid_times(p, scale), q_whole = solid_times(q, scale);
    if (scale == 1 || !p_whole || !q_whole) continue;
    SolidDepth of_results = *SolidDepth::create(p, q), whole = *SolidDepth::create(*p_whole, *q_whole);
    std::vector<RationalPoint3> moves;  // of the solids in integers
    for (int k = 0; k < 6; ++k) {
      const auto step = [&] {
        return exact::to_rational(BigRational(BigInteger(scale * (random.below(17) - 8)), BigInteger(4)));
      };
      moves.push_back({step(), step(), step()});
    }
    // Moved out of each other they touch.
    const SolidDistance out = whole.at(moves[0]);
    if (!out.ways.empty()) {
      const RationalPoint3 &m = moves[0], &w = out.ways[0].move;
      moves.push_back({m.x + w.x, m.y + w.y, m.z + w.z});
    }
    for (const RationalPoint3& move : moves) {
      const SolidDistance expected = whole.at(move), found = of_results.at(quotient(move, scale));
      ASSERT_EQ(found.meeting, expected.meeting);
      EXPECT_EQ(found.squared, quotient(quotient(expected.squared, scale), scale));
      ASSERT_EQ(found.ways.size(), expected.ways.size());
      for (std::size_t k = 0; k < found.ways.size(); ++k)
        EXPECT_EQ(found.ways[k].move, quotient(expected.ways[k].move, scale));
      (found.meeting == Meeting::overlapping ? overlapping : found.meeting == Meeting::apart ? apart : touching) += 1;
      for (const RationalPoint3& way : {RationalPoint3{1, 0, 0}, RationalPoint3{-1, 2, 3}})
        EXPECT_EQ(of_results.along(quotient(move, scale), way), quotient(whole.along(move, way), scale));
    }
  }
  EXPECT_GT(overlapping, rounds(60));
  EXPECT_GT(apart, rounds(60) / 4);
  EXPECT_GT(touching, rounds(60) / 4);
}

TEST(ResultDepth, TightPositionsAreFree) {
  // A peg of width 2/3 in a slot of 2/3 touches along the slot, with the open sum on both sides.
  const auto third = [](double x0, double y0, double z0, double x1, double y1, double z1) {
    std::vector<Point3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? x1 : x0, k & 2 ? y1 : y0, k & 4 ? z1 : z0});
    return *convex_hull(corners);
  };
  // Thirds by a tilted tool: the wedge's top plane is at x = 2/3 where z = 1.
  const Mesh block = third(-3, -3, -3, 3, 3, 4);
  const Mesh wedge =
      *convex_hull(std::vector<Point3>{{0, -1, 0}, {0, 1, 0}, {2, -1, 0}, {2, 1, 0}, {0, -1, 3}, {0, 1, 3}});
  const SpatialSum notched = *difference(block, wedge);  // the notch reaches to x = 2 (3 - z) / 3
  const SpatialSum peg = *intersection(wedge, third(-1, -1, 1, 3, 1, 2));
  SolidDepth depth = *SolidDepth::create(notched, peg);
  const SolidDistance fits = depth.at({});
  EXPECT_EQ(fits.meeting, Meeting::touching);
  EXPECT_EQ(depth.along(Point3{}, {1, 0, 0}), Rational());
  EXPECT_EQ(depth.at({1, 0, 0}).meeting, Meeting::overlapping);
  EXPECT_EQ(depth.at({0, 0.5, 0}).meeting, Meeting::overlapping);
  EXPECT_EQ(depth.along(Point3{0, 0.5, 0}, {0, -1, 0}), *Rational::of(1, 2));
  EXPECT_EQ(SolidDepth::create(notched, Mesh()).error().code, ErrorCode::no_area);
}

}  // namespace
}  // namespace dymsum::oracles
