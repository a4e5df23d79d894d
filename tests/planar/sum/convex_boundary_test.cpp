// Convex operands: which ones are distinguished, and the same sums as by the reference.
#include "oracles/snapped_shapes.h"
#include "planar/sum/minkowski_sum.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

bool answers(const Region& a, const Region& b) {
  const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
  const std::shared_ptr<const Lattice> lattice = make_lattice(kept_p->points, kept_q->points, 0);
  return convex_boundary(*lattice, *placed_on(*lattice, kept_p), *placed_on(*lattice, kept_q)).has_value();
}

PlanarSum by(Engine engine, const Region& p, const Region& q) {
  SumOptions options;
  options.engine = engine;
  return minkowski_sum(p, q, options).value();
}

Region plate_with_hole(double hole) {
  const Ring ring{{3, 3}, {3, 3 + hole}, {3 + hole, 3 + hole}, {3 + hole, 3}};
  return Region::create({{{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {ring}}}, {}, {}}).value();
}

TEST(ConvexBoundary, is_for_two_convex_operands_whose_holes_are_filled) {
  const Region square = shapes::rectangle(0, 0, 2, 2), disc = snapped_shapes::disc(12, 1),
               star = snapped_shapes::star(5, 1, 3);
  EXPECT_TRUE(answers(square, disc));
  EXPECT_TRUE(answers(square, square));
  EXPECT_FALSE(answers(star, square));
  EXPECT_FALSE(answers(square, star));
  EXPECT_TRUE(answers(plate_with_hole(1), square));
  EXPECT_TRUE(answers(square, plate_with_hole(1)));
  EXPECT_FALSE(answers(plate_with_hole(2), square)) << "it fits exactly";
  EXPECT_FALSE(answers(square, plate_with_hole(3)));
  EXPECT_FALSE(answers(Region::create({{}, {{{0, 0}, {1, 1}}}, {}}).value(), square));
  EXPECT_FALSE(answers(square, Region::create({{}, {}, {{1, 1}}}).value()));
  const Region two = Region::create({{{{{0, 0}, {1, 0}, {0, 1}}, {}}, {{{5, 5}, {6, 5}, {5, 6}}, {}}}, {}, {}}).value();
  EXPECT_FALSE(answers(two, square));
  EXPECT_FALSE(answers({}, square));
}

// Parallel edges, the same operand twice, holes, and operands of very different size.
TEST(ConvexBoundary, equals_the_reference) {
  const Region shapes[] = {shapes::rectangle(0, 0, 2, 1),     shapes::rectangle(-1, 3, 4, 8),
                           snapped_shapes::disc(3, 2),        snapped_shapes::disc(16, 1),
                           snapped_shapes::disc(33, 1.0 / 3), plate_with_hole(1),
                           snapped_shapes::disc(8, 0x1p-300), snapped_shapes::disc(5, 0x1p200)};
  for (const Region& p : shapes)
    for (const Region& q : shapes) {
      SCOPED_TRACE(oracles::to_text(p.data(), q.data()));
      const PlanarSum sum = by(Engine::fast, p, q);
      EXPECT_TRUE(sum == by(Engine::brute, p, q));
      EXPECT_EQ(sum.stats.pair_tests == 0, answers(p, q)) << "which path answered";
    }
}

TEST(ConvexBoundary, equals_the_sum_by_definition_on_tiny_grids) {
  constexpr std::uint64_t kSeed = 577215;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  int convex = 0;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    oracles::Random random(kSeed + k);
    const auto polygon = [&] {
      Ring ring = oracles::random_polygon(random, 2 + random.below(4), 3 + random.below(3));
      return Region::create({{{std::move(ring), {}}}, {}, {}});
    };
    const auto p = polygon(), q = polygon();
    if (!p.ok() || !q.ok() || !answers(*p, *q)) continue;
    ++convex;
    const PlanarSum sum = by(Engine::fast, *p, *q);
    ASSERT_TRUE(sum == by(Engine::brute, *p, *q)) << oracles::to_text(p->data(), q->data());
    ASSERT_EQ(oracles::spot_check_sum(*p, *q, sum, 10, k), "") << oracles::to_text(p->data(), q->data());
  }
  EXPECT_GT(convex, 300);
}

TEST(ConvexBoundary, edges_whose_directions_doubles_cannot_tell_apart) {
  // (2^40, 2^40 + 1) and (2^40 - 1, 2^40): slopes 2^-80 apart.
  const double a = 0x1p40;
  const Region p = Region::create({{{{{0, 0}, {a, a + 1}, {0, a}}, {}}}, {}, {}}).value();
  const Region q = Region::create({{{{{0, 0}, {a - 1, a}, {0, a}}, {}}}, {}, {}}).value();
  for (const auto& [r, s] : {std::pair{p, q}, std::pair{q, p}}) {
    const PlanarSum sum = by(Engine::fast, r, s);
    EXPECT_TRUE(sum == by(Engine::brute, r, s));
    EXPECT_EQ(sum.vertex_count(), 5u);
  }
}

}  // namespace
}  // namespace dymsum::planar
