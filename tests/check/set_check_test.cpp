// Sets of anyone against the right ones: planted faults are found with their exact size and distance, right sets pass,
// and distances are those of many positions.
#include "dymsum/set_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/penetration_depth.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/shapes.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "dymsum/sum_locator.h"
#include "oracles/decimal_parts.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

Region polygon(Ring outer, std::vector<Ring> holes = {}) {
  return *Region::create({{{std::move(outer), std::move(holes)}}, {}, {}});
}
Region box(double x0, double y0, double x1, double y1) { return shapes::rectangle(x0, y0, x1, y1); }
Rational ratio(std::int64_t num, std::int64_t den = 1) { return *Rational::of(num, den); }
RationalPoint point_at(double x, double y) { return {*Rational::of(x), *Rational::of(y)}; }

/// The distance of z from the boundary of a region, in doubles.
double distance_to(const Region& region, Point z) {
  double least = INFINITY;
  const auto see = [&](Point a, Point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, n = dx * dx + dy * dy;
    const double t = n > 0 ? std::clamp(((z.x - a.x) * dx + (z.y - a.y) * dy) / n, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(a.x + t * dx - z.x, a.y + t * dy - z.y));
  };
  const auto ring = [&](const Ring& r) {
    for (std::size_t k = 0; k < r.size(); ++k) see(r[k], r[(k + 1) % r.size()]);
  };
  for (const Part& part : region.parts()) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
  return least;
}

TEST(SetCheck, RightSetsPass) {
  const Region p = shapes::letter_l(4, 3, 1), q = shapes::gear(7, 1, 2);
  const PlanarSum sum = *minkowski_sum(p, q);
  const PlanarSetCheck check = *check_set(sum, sum);
  EXPECT_TRUE(check.equal());
  EXPECT_EQ(check.missing.at_most, 0);
  EXPECT_EQ(check.within(0), CheckVerdict::right);
  EXPECT_EQ(check.within(ratio(-1, 8)), CheckVerdict::wrong);
  EXPECT_TRUE(check_set(Region(), Region())->equal());
}

TEST(SetCheck, WhatLiesBetweenSetsThatAreUnitedIsNotMissing) {
  const PlanarSum halves = *united(box(0, 0, 1, 1), box(1, 0, 2, 1));
  SetCheckOptions closed;
  closed.semantics = Semantics::closed;
  EXPECT_TRUE(check_set(box(0, 0, 2, 1), halves, closed)->equal());
  EXPECT_TRUE(check_set(halves, box(0, 0, 2, 1), closed)->equal());
  const PlanarSum touching = *intersection(box(0, 0, 1, 1), box(1, 0, 2, 1));
  EXPECT_TRUE(check_set(halves, touching, closed)->contained());
  EXPECT_FALSE(check_set(box(0, 0, 0.5, 1), touching, closed)->contained());
}

TEST(SetCheck, ACornerThatIsCutOffIsFoundWithItsDistance) {
  const Region right = box(0, 0, 4, 4), made = polygon({{0, 0}, {4, 0}, {4, 3}, {3, 4}, {0, 4}});
  const PlanarSetCheck check = *check_set(right, made);
  EXPECT_FALSE(check.contains());
  EXPECT_TRUE(check.contained());
  EXPECT_EQ(check.missing.set.area_exact(), ratio(1, 2));
  EXPECT_EQ(check.missing.at, point_at(4, 4));
  EXPECT_EQ(check.missing.nearest, point_at(3.5, 3.5));
  EXPECT_EQ(check.missing.squared, ratio(1, 2));
  EXPECT_TRUE(check.missing.exact);
  EXPECT_EQ(check.within(ratio(7, 10)), CheckVerdict::wrong);
  EXPECT_EQ(check.within(ratio(5, 7)), CheckVerdict::right);  // 25/49 > 1/2
  const PlanarSetCheck other = *check_set(made, right);
  EXPECT_TRUE(other.contains());
  EXPECT_EQ(other.surplus.squared, ratio(1, 2));
}

TEST(SetCheck, FurthestPositionsInsideAreExactWhereEdgesAreParallel) {
  // A slot that was closed: all of its midline is equally far from both walls.
  const Region right = polygon({{0, 0}, {9, 0}, {9, 4}, {5, 4}, {5, 1}, {4, 1}, {4, 4}, {0, 4}});
  const PlanarSetCheck slot = *check_set(right, box(0, 0, 9, 4));
  EXPECT_TRUE(slot.surplus.exact);
  EXPECT_EQ(slot.surplus.squared, ratio(1, 4));
  EXPECT_EQ(slot.surplus.at_most, 0.5);
  EXPECT_EQ(slot.within(ratio(1, 2)), CheckVerdict::right);
  const Region holed = polygon({{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 3}, {3, 6}, {6, 6}, {6, 3}}});
  const PlanarSetCheck hole = *check_set(holed, box(0, 0, 9, 9));
  EXPECT_TRUE(hole.surplus.exact);
  EXPECT_EQ(hole.surplus.squared, ratio(9, 4));
  EXPECT_EQ(hole.surplus.at, point_at(4.5, 4.5));
}

TEST(SetCheck, WhatIsNoFractionIsBetweenTwoBounds) {
  // The centre of the circle that touches all three sides.
  const Region holed = polygon({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {{{0, 0}, {1, 2}, {3, 0}}});
  const PlanarSetCheck check = *check_set(holed, box(-9, -9, 9, 9));
  const double a = 3, b = std::sqrt(5.0), c = std::sqrt(8.0), radius = 2 * 3.0 / (a + b + c);
  EXPECT_FALSE(check.surplus.exact);
  EXPECT_LE(check.surplus.distance, radius * (1 + 1e-15));
  EXPECT_GE(check.surplus.at_most, radius * (1 - 1e-15));
  EXPECT_LE(check.surplus.at_most, check.surplus.distance * (1 + 1e-10));
  EXPECT_EQ(check.within(*Rational::of(check.surplus.at_most)), CheckVerdict::right);
  EXPECT_EQ(check.within(*Rational::of(radius * (1 - 1e-9))), CheckVerdict::wrong);
  const Rational between = (*Rational::of(check.surplus.at_most) + *Rational::of(check.surplus.distance)) / 2;
  EXPECT_EQ(check.within(between), CheckVerdict::undecided);
}

TEST(SetCheck, ExactFitsCountWithClosedSemantics) {
  const Region frame = polygon({{0, 0}, {9, 0}, {9, 9}, {5, 9}, {5, 5}, {4, 5}, {4, 9}, {0, 9}});
  const PlanarSum fit = *erode(frame, box(0, 0, 4, 1));
  ASSERT_FALSE(fit.segments.empty());
  SumOptions regular;
  regular.semantics = Semantics::regular;
  const PlanarSum parts = *erode(frame, box(0, 0, 4, 1), regular);
  EXPECT_TRUE(check_set(fit, parts)->equal());
  SetCheckOptions closed;
  closed.semantics = Semantics::closed;
  const PlanarSetCheck check = *check_set(fit, parts, closed);
  EXPECT_FALSE(check.contains());
  EXPECT_TRUE(check.contained());
  EXPECT_EQ(check.missing.squared, ratio(16));  // beside the slot, up to y = 8
  EXPECT_TRUE(check_set(fit, fit, closed)->equal());
  closed.semantics = Semantics::open;
  EXPECT_EQ(check_set(fit, fit, closed).error().code, ErrorCode::unsupported_operand);
}

TEST(SetCheck, NothingIsInfinitelyFarFromSomething) {
  const PlanarSetCheck check = *check_set(box(0, 0, 1, 1), Region());
  EXPECT_TRUE(std::isinf(check.missing.distance));
  EXPECT_TRUE(check.contained());
  EXPECT_EQ(check.within(ratio(1'000'000'000)), CheckVerdict::wrong);
}

TEST(SetCheck, DistancesAreThoseOfManyPositions) {
  Random random(20261130);
  int inexact = 0, apart = 0;
  for (int round = 0; round < rounds(150); ++round) {
    SCOPED_TRACE(round);
    const Region a = *Region::create(random_parts(random, 6)), b = *Region::create(random_parts(random, 6));
    const PlanarSetCheck check = *check_set(a, b);
    for (const bool missing : {true, false}) {
      const PlanarExcess& excess = missing ? check.missing : check.surplus;
      const Region &of = missing ? a : b, &from = missing ? b : a;
      const SumLocator own(*union_of({of})), other(*union_of({from}));
      double most = 0;
      for (int x = -16; x <= 112; ++x)
        for (int y = -16; y <= 112; ++y)
          if (const Point z{x / 16.0, y / 16.0}; own.contains(z) && !other.contains(z))
            most = std::max(most, distance_to(from, z));
      EXPECT_LE(most, excess.at_most * (1 + 1e-12));
      EXPECT_GE(excess.at_most, excess.distance);
      EXPECT_LE(excess.at_most, excess.distance * (1 + 1e-10));
      if (excess.set.parts.empty()) continue;
      EXPECT_TRUE(own.contains_rational(excess.at));
      const Point at{excess.at.x.to_double(), excess.at.y.to_double()};
      EXPECT_NEAR(distance_to(from, at), excess.distance, 1e-12);
      // Positions of a lattice are that near to the furthest one, whose surroundings are wide.
      EXPECT_GE(most, excess.distance - 0.7);
      const Rational dx = excess.at.x - excess.nearest.x, dy = excess.at.y - excess.nearest.y;
      EXPECT_EQ(dx * dx + dy * dy, excess.squared);
      EXPECT_TRUE(SumLocator(*union_of({from})).contains_rational(excess.nearest));
      inexact += !excess.exact;
      ++apart;
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(inexact, 0);
}

TEST(SetCheck, RoundedSumsAreNearTheExactOnes) {
  std::mt19937_64 random(20261130);
  for (int round = 0; round < rounds(20); ++round) {
    SCOPED_TRACE(round);
    const Region p = decimal_parts(random, 12, 7, 3, 0.1), q = decimal_parts(random, 5, 5, 1, 0.3);
    const PlanarSum sum = *minkowski_sum(p, q);
    const PlanarSetCheck check = *check_set(sum, sum.rounded_with_repair()->region);
    EXPECT_EQ(check.within(*Rational::of(1e-13)), CheckVerdict::right);
    EXPECT_LT(std::max(check.missing.at_most, check.surplus.at_most), 1e-13);
  }
}

TEST(SetCheck, CoordinatesMayBeAsLargeAndAsSmallAsTheyLike) {
  for (const double size : {1e-300, 1e300}) {
    const Region right = box(0, 0, 4 * size, 4 * size),
                 made = polygon({{0, 0}, {4 * size, 0}, {4 * size, 3 * size}, {3 * size, 4 * size}, {0, 4 * size}});
    const PlanarSetCheck check = *check_set(right, made);
    EXPECT_NEAR(check.missing.distance / size, std::sqrt(0.5), 1e-12);
    EXPECT_TRUE(check.missing.exact);
  }
}

TEST(SetCheck, StopsOnRequest) {
  SetCheckOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(check_set(box(0, 0, 1, 1), box(0, 0, 2, 1), options).error().code, ErrorCode::cancelled);
}

TEST(SolidSetCheck, RightSolidsPassAndFaultsHaveTheirSize) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1), slab = solids::box(0, 0, 0, 3, 2, 1);
  const SpatialSum sum = *minkowski_sum(cube, slab);
  EXPECT_TRUE(check_set(sum, sum)->equal());
  EXPECT_TRUE(check_set(sum, solids::box(0, 0, 0, 4, 3, 2))->equal());
  const SolidSetCheck check = *check_set(sum, solids::box(0, 0, -1, 4, 3, 1.5));
  EXPECT_FALSE(check.contains() || check.contained());
  EXPECT_EQ(check.missing.set.volume_exact(), ratio(6));
  EXPECT_EQ(check.missing.squared, ratio(1, 4));
  EXPECT_EQ(check.surplus.set.volume_exact(), ratio(12));
  EXPECT_EQ(check.surplus.squared, ratio(1));
  EXPECT_TRUE(check.missing.exact && check.surplus.exact);
  EXPECT_EQ(check.within(ratio(1)), CheckVerdict::right);
  EXPECT_EQ(check.within(ratio(99, 100)), CheckVerdict::wrong);
  EXPECT_TRUE(std::isinf(check_set(sum, Mesh())->missing.distance));
  EXPECT_TRUE(check_set(SpatialSum(), Mesh())->equal());
}

TEST(SolidSetCheck, DistancesAreThoseOfManyPositions) {
  // Frames and slabs: the furthest position is as far as it says, and nothing is further than the bound.
  Random random(20261130);
  int coarse = 0;
  const auto corner = [&] { return random.below(8) / 4.0; };
  for (int round = 0; round < rounds(12); ++round) {
    SCOPED_TRACE(round);
    const auto solid = [&] {
      const double x = corner(), y = corner(), z = corner();
      const Mesh parts[]{solids::box(x, y, z, x + 1, y + 2, z + 1.5), solids::box(y, z, x, y + 2, z + 0.5, x + 1)};
      return *united(parts);
    };
    const SpatialSum a = solid(), b = solid();
    const SolidSetCheck check = *check_set(a, b);
    const Mesh of_b = *as_mesh(b), of_a = *as_mesh(a), point = *Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}});
    SolidDepth depth = *SolidDepth::create(of_b, point);
    const double at_most = check.missing.at_most;
    double most = 0;
    for (int x = 0; x <= 20; x += 2)
      for (int y = 0; y <= 20; y += 2)
        for (int z = 0; z <= 20; z += 2) {
          const Point3 p{x / 5.0, y / 5.0, z / 5.0};
          if (!*contains(of_a, point, p)) continue;
          const SolidDistance d = depth.at(p);
          if (d.meeting == Meeting::apart) most = std::max(most, d.distance);
        }
    EXPECT_LE(most, at_most * (1 + 1e-12));
    if (!check.missing.set.faces.empty()) {
      const SolidDistance d = depth.at(check.missing.at);
      EXPECT_EQ(d.squared, check.missing.squared);
    }
    coarse += !check.missing.exact;
    EXPECT_GE(at_most, check.missing.distance);
    EXPECT_LE(at_most, check.missing.distance * (1 + 0x1p-29));
  }
  EXPECT_LT(coarse, 12);
}

TEST(SolidOffsetCheck, DistancesOfBoxesAroundABox) {
  const Mesh a = solids::box(0, 0, 0, 4, 4, 4), made = solids::box(-1, -1, -2, 5, 5, 5);
  const SolidOffsetCheck check = *check_offset(a, made, DiscSide::outside);
  EXPECT_EQ(check.least, 1);
  EXPECT_EQ(check.between.squared, ratio(6));
  EXPECT_TRUE(check.between.exact);
  EXPECT_EQ(check.at_least(1), CheckVerdict::right);
  EXPECT_EQ(check.at_least(ratio(1001, 1000)), CheckVerdict::wrong);
  EXPECT_EQ(check.at_most(ratio(5, 2)), CheckVerdict::right);
  EXPECT_EQ(check.at_most(ratio(12, 5)), CheckVerdict::wrong);
  const SolidOffsetCheck shrunk = *check_offset(made, a, DiscSide::inside);
  EXPECT_EQ(shrunk.least, 1);
  EXPECT_EQ(shrunk.at_most(ratio(1, 2)), CheckVerdict::wrong);
  EXPECT_EQ(shrunk.at_most(100), CheckVerdict::right);
  const SolidOffsetCheck out = *check_offset(a, solids::box(-1, -1, -1, 5, 5, 3.5), DiscSide::outside);
  EXPECT_EQ(out.at_least(0), CheckVerdict::wrong);
  EXPECT_EQ(out.beyond.squared, ratio(1, 4));
}

TEST(SolidOffsetCheck, NearestPositionsMayLieInsideTwoEdges) {
  // A notch whose edge crosses that of the box at a distance.
  const Point3 far[]{{2, 1, 0.5}, {1, 2, 0.5}, {9, 8, -3}, {8, 9, -3}, {9, 8, 4}, {8, 9, 4}};
  const Mesh made = *difference(solids::box(-3, -3, -3, 4, 4, 4), *convex_hull(far))->rounded_mesh();
  const SolidOffsetCheck check = *check_offset(solids::box(0, 0, 0, 1, 1, 1), made, DiscSide::outside);
  EXPECT_EQ(check.least_squared, ratio(1, 2));
  EXPECT_EQ(check.least_from, (RationalPoint3{1, 1, ratio(1, 2)}));
  EXPECT_EQ(check.least_at, (RationalPoint3{ratio(3, 2), ratio(3, 2), ratio(1, 2)}));
}

TEST(OffsetCheck, DistancesOfASquareAroundASquare) {
  const Region a = box(0, 0, 4, 4), made = box(-1, -2, 5, 5);
  const PlanarOffsetCheck check = *check_offset(a, made, DiscSide::outside);
  EXPECT_EQ(check.least, 1);
  EXPECT_EQ(check.between.squared, ratio(5));
  EXPECT_EQ(check.at_least(1), CheckVerdict::right);
  EXPECT_EQ(check.at_least(ratio(1000001, 1000000)), CheckVerdict::wrong);
  EXPECT_EQ(check.at_most(ratio(9, 4)), CheckVerdict::right);
  EXPECT_EQ(check.at_most(ratio(11, 5)), CheckVerdict::wrong);
  const PlanarOffsetCheck shrunk = *check_offset(made, a, DiscSide::inside);
  EXPECT_EQ(shrunk.least, 1);
  EXPECT_EQ(shrunk.between.squared, ratio(4));  // a corner's outside is beside it: (0, 0) is 1 and 2 from the sides
}

TEST(OffsetCheck, OffsetsByPolygonsOfArcs) {
  const Region a = shapes::letter_l(5, 4, 1.3);
  const GrowingDisc disc(a);
  for (const DiscSide side : {DiscSide::outside, DiscSide::inside})
    for (const DiscBound bound : {DiscBound::inside, DiscBound::outside}) {
      const Rational r = ratio(2, 5);
      const DiscSet set = side == DiscSide::outside ? *disc.sum_at(r) : *disc.eroded_at(r);
      const DiscPolygons polygons = *to_region(set, 1e-3, bound);
      const PlanarOffsetCheck check = *check_offset(a, polygons.region, side);
      // Before their vertices are rounded, polygons are on their side: that is seen, too.
      const Rational e = *Rational::of(polygons.error), ulp = *Rational::of(2 * polygons.rounded);
      EXPECT_NE(check.at_least(r - e), check.at_least(r + e));
      // Around the grown set, or in the shrunk one, no less than r is kept.
      const bool keeps = (side == DiscSide::outside) == (bound == DiscBound::outside);
      EXPECT_EQ(check.at_least(keeps ? r - ulp : r - e), CheckVerdict::right);
      if (!keeps) {
        EXPECT_EQ(check.at_most(r + ulp), CheckVerdict::right);
      }
      if (keeps && side == DiscSide::outside) {
        EXPECT_EQ(check.at_most(r + e), CheckVerdict::right);
      }
      EXPECT_EQ(check.at_least(r + e), CheckVerdict::wrong);
    }
}

TEST(OffsetCheck, WhatSticksOutIsNoOffset) {
  const Region a = box(0, 0, 4, 4);
  const PlanarOffsetCheck check = *check_offset(a, box(-1, -1, 5, 3.5), DiscSide::outside);
  EXPECT_EQ(check.at_least(0), CheckVerdict::wrong);
  EXPECT_EQ(check.beyond.distance, 0.5);
  EXPECT_EQ(check.least, 0);
  EXPECT_EQ(check_offset(a, Region(), DiscSide::inside)->at_least(100), CheckVerdict::right);
  EXPECT_EQ(check_offset(a, Region(), DiscSide::inside)->at_most(2), CheckVerdict::right);
  EXPECT_EQ(check_offset(a, Region(), DiscSide::inside)->at_most(ratio(19, 10)), CheckVerdict::wrong);
}

}  // namespace
}  // namespace dymsum::oracles
