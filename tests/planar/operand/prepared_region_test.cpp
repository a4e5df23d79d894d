// What sums keep with a region must not show: not between copies, roles and partners, nor between threads.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "exact/grid.h"
#include "oracles/snapped_shapes.h"
#include "planar/operand/operand.h"

namespace dymsum {
namespace {

TEST(PreparedRegion, IsSharedByCopiesAndMadeOncePerRole) {
  const Region star = snapped_shapes::star(7, 1, 3);
  const Region copy = star;
  EXPECT_EQ(planar::prepared_operand(star, 0), planar::prepared_operand(copy, 0));
  EXPECT_EQ(planar::prepared_operand(star, 1, true), planar::prepared_operand(copy, 1, true));
  EXPECT_NE(planar::prepared_operand(star, 0), planar::prepared_operand(star, 1));
  EXPECT_NE(planar::prepared_operand(star, 1), planar::prepared_operand(star, 1, true));
  EXPECT_EQ(planar::prepared_operand(Region(), 0)->size(), 0u);
}

// The same region first with a partner of its own size, then with a huge, a minute and a far one.
TEST(PreparedRegion, ServesPartnersOfEverySize) {
  const Region p = shapes::random_polygon(12, 3, 5);
  for (const double factor : {1.0, 0x1p80, 0x1p-80, 0x1p500, 0x1p-500}) {
    const Region q = scaled(snapped_shapes::star(5, 1, 2), factor, factor).value();
    const Region fresh_p = Region::create(p.data()).value(), fresh_q = Region::create(q.data()).value();
    SumOptions brute;
    brute.engine = Engine::brute;
    EXPECT_TRUE(minkowski_sum(p, q).value() == minkowski_sum(fresh_p, fresh_q, brute).value()) << factor;
    EXPECT_TRUE(nfp(p, q).value() == minkowski_sum(fresh_p, negated(fresh_q), brute).value()) << factor;
    EXPECT_TRUE(minkowski_sum(q, p).value() == minkowski_sum(fresh_p, fresh_q, brute).value()) << factor;
  }
}

// What is counted once stands for every grid.
TEST(PreparedRegion, KnowsTheBitsOfItsIntegers) {
  for (const double extent : {0.0, 0x1p-1074, 0x1p-300, 0.75, 1.0, 3.0, 4.0, 0x1.fffffffffffffp9, 1024.0, 0x1p600}) {
    const auto points = planar::place_points({{0, 0}, {extent, 0}});
    ASSERT_EQ(points->extent, extent);
    for (int grid = -1074; grid < 700; grid += 1 + std::abs(grid) / 50)
      ASSERT_EQ(points->bits(grid), exact::bits_needed(std::nextafter(extent, INFINITY), grid))
          << extent << " " << grid;
  }
}

TEST(PreparedRegion, IsMadeOnceByManyThreads) {
  for (int round = 0; round < 20; ++round) {
    const Region p = shapes::noisy_star(40, 0.5, round), q = shapes::noisy_star(30, 0.5, 100 + round);
    const PlanarSum expected =
        minkowski_sum(Region::create(p.data()).value(), Region::create(q.data()).value()).value();
    std::atomic<int> equal = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) threads.emplace_back([&] { equal += minkowski_sum(p, q).value() == expected; });
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(equal, 4);
  }
}

// Of a plate's holes the sum fills one: what it makes of the plate's directions is its own, not kept with the plate.
TEST(PreparedRegion, ServesManyThreadsWhoseSumsFillSomeHoles) {
  const auto square = [](double x, double y, double side) {
    return Ring{{x, y}, {x, y + side}, {x + side, y + side}, {x + side, y}};
  };
  RegionData plate{{{{{0, 0}, {200, 0}, {200, 10}, {0, 10}}, {}}}, {}, {}};
  for (int k = 0; k < 30; ++k) plate.parts[0].holes.push_back(square(6 * k + 1, 1, k % 2 == 0 ? 4 : 0.5));
  const Region p = Region::create(plate).value(), q = snapped_shapes::disc(16, 1);
  const PlanarSum expected = minkowski_sum(p, q).value();
  ASSERT_EQ(expected.hole_count(), 15u);
  std::atomic<int> equal = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) equal += minkowski_sum(p, q).value() == expected;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(equal, 400);
}

// A reflection is read off the region as it is: parts, holes that touch, polylines, points.
TEST(PreparedRegion, ReflectsEveryKindOfPiece) {
  const Ring outer{{0, 0}, {8, 0}, {8, 8}, {0, 8}};
  const Region b =
      Region::create({{{outer, {{{0, 4}, {2, 6}, {3, 4}}, {{3, 4}, {5, 5}, {5, 3}}}}, {{{8, 8}, {9, 8}, {9, 9}}, {}}},
                      {{{10, 0}, {12, 1}, {10, 2}, {10, 0}}, {{-3, -3}, {-2, -3}}},
                      {{-1, 5}, {0, -4}}})
          .value();
  ASSERT_FALSE(b.touching_points().empty());
  for (const Region& a : {shapes::rectangle(0, 0, 0.5, 0.25), snapped_shapes::star(5, 1, 2)}) {
    const PlanarSum reflected = nfp(a, b).value(), expected = minkowski_sum(a, negated(b)).value();
    EXPECT_TRUE(reflected == expected);
    EXPECT_EQ(reflected.area_exact(), expected.area_exact());
  }
}

}  // namespace
}  // namespace dymsum
