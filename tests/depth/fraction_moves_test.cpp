// Depth at moves in fractions is that of solids and regions three times as large at three times the move.
#include <gtest/gtest.h>

#include <span>

#include "dymsum/penetration_depth.h"
#include "dymsum/region.h"
#include "dymsum/shapes.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

Rational third(int k) { return *Rational::of(k, 3); }

RationalPoint3 over_three(const RationalPoint3& v) { return {v.x * third(1), v.y * third(1), v.z * third(1)}; }

TEST(FractionMoves, of_solids_are_exact) {
  const Mesh p = Mesh::create(ell()).value(), q = Mesh::create(tunnel()).value(), p3 = *scaled(p, 3, 3, 3),
             q3 = *scaled(q, 3, 3, 3);
  for (const DepthEngine engine : {DepthEngine::search, DepthEngine::boundary}) {
    DepthOptions options;
    options.engine = engine;
    SolidDepth pair = SolidDepth::create(p, q, options).value(), larger = SolidDepth::create(p3, q3, options).value();
    std::vector<RationalPoint3> moves;
    std::vector<SolidDistance> rows;
    int overlapping = 0;
    for (int x = -2; x <= 8; x += 2)
      for (int z = -4; z <= 8; z += 3) {
        const RationalPoint3 move{third(x), *Rational::of(1, 7), third(z)};
        const Rational seven = 7;
        const SolidDistance d = pair.at(move);
        moves.push_back(move), rows.push_back(d);
        // 21 times as large is no small change, but thirds alone are seen at three times.
        const SolidDistance thirds = pair.at(RationalPoint3{third(x), third(1), third(z)}),
                            whole = larger.at({double(x), 1, double(z)});
        EXPECT_EQ(thirds.meeting, whole.meeting);
        EXPECT_EQ(thirds.squared * Rational(9), whole.squared);
        ASSERT_EQ(thirds.ways.size(), whole.ways.size());
        for (std::size_t k = 0; k < whole.ways.size(); ++k) {
          EXPECT_EQ(thirds.ways[k].move, over_three(whole.ways[k].move));
          ASSERT_EQ(thirds.ways[k].contacts.size(), whole.ways[k].contacts.size());
          for (std::size_t c = 0; c < whole.ways[k].contacts.size(); ++c) {
            const SolidTouch &a = thirds.ways[k].contacts[c], &b = whole.ways[k].contacts[c];
            EXPECT_EQ(std::tie(a.p, a.q, a.dimension, a.patch), std::tie(b.p, b.q, b.dimension, b.patch));
            EXPECT_EQ(a.at, over_three(b.at));
          }
        }
        overlapping += thirds.meeting == Meeting::overlapping;
        const RationalPoint3 way{third(1), Rational(0), third(-1)};
        EXPECT_EQ(pair.along(RationalPoint3{third(x), third(1), third(z)}, way),
                  larger.along({double(x), 1, double(z)}, {1, 0, -1}));
        EXPECT_EQ(pair.along(move, way) * seven,
                  pair.along(move, RationalPoint3{third(1) / seven, 0, third(-1) / seven}));
      }
    EXPECT_GT(overlapping, 3);
    EXPECT_TRUE(depth_batch(pair, std::span<const RationalPoint3>(moves)).value() == rows);
    EXPECT_TRUE(pair.at(RationalPoint3{1, 2, 3}) == pair.at({1, 2, 3}));
  }
}

TEST(FractionMoves, of_regions_are_exact) {
  const Region p = shapes::letter_u(4, 4, 1), q = shapes::letter_l(2, 3, 1), p3 = *scaled(p, 3, 3),
               q3 = *scaled(q, 3, 3);
  const PlanarDepth pair = PlanarDepth::create(p, q).value(), larger = PlanarDepth::create(p3, q3).value();
  int overlapping = 0;
  for (int x = -10; x <= 14; ++x)
    for (int y = -10; y <= 14; ++y) {
      const PlanarDistance d = pair.at(RationalPoint{third(x), third(y)}), whole = larger.at({double(x), double(y)});
      EXPECT_EQ(d.meeting, whole.meeting);
      EXPECT_EQ(d.squared * Rational(9), whole.squared);
      ASSERT_EQ(d.ways.size(), whole.ways.size());
      for (std::size_t k = 0; k < whole.ways.size(); ++k) {
        EXPECT_EQ(d.ways[k].move, (RationalPoint{whole.ways[k].move.x * third(1), whole.ways[k].move.y * third(1)}));
        EXPECT_EQ(d.ways[k].contacts.size(), whole.ways[k].contacts.size());
      }
      overlapping += d.meeting == Meeting::overlapping;
    }
  EXPECT_GT(overlapping, 50);
}

}  // namespace
}  // namespace dymsum::test
