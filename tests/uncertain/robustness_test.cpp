// Robustness against distances of all pairs of edges, exactly, and against shapes that are changed by as much; stacks
// of fits in closed form.
#include "dymsum/robustness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "dymsum/growing_disc.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "sets.h"

namespace dymsum::oracles {
namespace {

Big squared_to(const Pt<Big>& z, const Pt<Big>& a, const Pt<Big>& b) {
  const Big dx = b.x - a.x, dy = b.y - a.y, tx = z.x - a.x, ty = z.y - a.y, all = dx * dx + dy * dy;
  Big t = (tx * dx + ty * dy) / all;
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const Big x = tx - t * dx, y = ty - t * dy;
  return x * x + y * y;
}

/// Of boundaries that do not cross.
Big squared_distance(const Region& p, const Region& q, const Pt<Big>& at) {
  std::optional<Big> least;
  const Pieces<Big> a = pieces_of<Big>(p.data()), b = pieces_of<Big>(q.data());
  for (const auto& e : a.rim)
    for (auto f : b.rim) {
      f.a = {f.a.x + at.x, f.a.y + at.y}, f.b = {f.b.x + at.x, f.b.y + at.y};
      for (const Big& d :
           {squared_to(e.a, f.a, f.b), squared_to(e.b, f.a, f.b), squared_to(f.a, e.a, e.b), squared_to(f.b, e.a, e.b)})
        if (!least || d < *least) least = d;
    }
  return *least;
}

TEST(Robustness, IsHalfOfTheGap) {
  const Robustness r = *robustness_of_free(box(0, 0, 1, 1), box(0, 0, 1, 1), at_point(4, 5));
  EXPECT_TRUE(r.holds);
  EXPECT_EQ(r.squared, ratio(25, 4));
  EXPECT_EQ(r.radius, 2.5);
  ASSERT_EQ(r.ways.size(), 1u);
  EXPECT_EQ(r.ways[0].move, at_point(-3, -4));
  ASSERT_EQ(r.ways[0].contacts.size(), 1u);
  EXPECT_EQ(r.ways[0].contacts[0].p, (PlanarFeature{PlanarFeature::Kind::vertex, 2}));
  EXPECT_EQ(r.ways[0].contacts[0].q, (PlanarFeature{PlanarFeature::Kind::vertex, 0}));
  EXPECT_EQ(robustness_of_free(box(0, 0, 1, 1), box(0, 0, 1, 1), at_point(1, 0))->radius, 0);
  EXPECT_TRUE(robustness_of_free(box(0, 0, 1, 1), box(0, 0, 1, 1), at_point(1, 0))->holds);
  const Robustness deep = *robustness_of_free(box(0, 0, 4, 4), box(0, 0, 1, 1), at_point(3.5, 1));
  EXPECT_FALSE(deep.holds);
  EXPECT_EQ(deep.radius, 0);
  EXPECT_EQ(deep.ways.at(0).move, at_point(0.5, 0));
  EXPECT_EQ(robustness_of_free(Region(), box(0, 0, 1, 1), {})->radius, INFINITY);
}

TEST(Robustness, OfFreePositionsIsThatOfAllPairsOfEdges) {
  Random random(21);
  int free = 0;
  for (int round = 0; round < rounds(200); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Region p = small_region(random, 6), q = small_region(random, 3);
    const RationalPoint at{ratio(random.below(33) - 8, 2), ratio(random.below(33) - 8, 3)};
    const Robustness r = *robustness_of_free(p, q, at);
    EXPECT_EQ(r.holds, !overlaps_open(p.data(), negated(q).data(), big(at)));
    if (!r.holds) continue;
    ++free;
    EXPECT_EQ(big(r.squared) * 4, squared_distance(p, q, big(at)));
    // Where Q is moved by the gap it touches, and does not overlap.
    for (const PlanarWay& way : r.ways) {
      const Pt<Big> there = big(RationalPoint{at.x + way.move.x, at.y + way.move.y});
      EXPECT_TRUE(meets_closed(p.data(), negated(q).data(), there));
      EXPECT_FALSE(overlaps_open(p.data(), negated(q).data(), there));
    }
  }
  EXPECT_GT(free, 40);
}

TEST(Robustness, OfFitsIsThatOfAllPairsOfEdges) {
  Random random(22);
  int fit = 0, not_fit = 0;
  for (int round = 0; round < rounds(50); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Region container = small_region(random, 8), part = small_region(random, 2);
    std::vector<RationalPoint> tried{{ratio(random.below(29), 4), ratio(random.below(22), 3)}};
    for (const RationalPoint& v : vertices_of(*erode(container, part)))
      tried.push_back(v), tried.push_back({v.x * ratio(7, 8) + ratio(1, 3), v.y * ratio(7, 8) + ratio(1, 3)});
    for (const RationalPoint& at : tried) {
      const Robustness r = *robustness_of_fit(container, part, at);
      EXPECT_EQ(r.holds, holds_closed(container.data(), part.data(), big(at)));
      (r.holds ? fit : not_fit)++;
      if (!r.holds) continue;
      EXPECT_EQ(big(r.squared) * 4, squared_distance(container, part, big(at)));
    }
  }
  EXPECT_GT(fit, 30);
  EXPECT_GT(not_fit, 30);
}

TEST(Robustness, NamesFeaturesOfTheContainer) {
  const Region frame = polygon({{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{4, 4}, {4, 5}, {5, 5}, {5, 4}}});
  const auto contact = [&](double x, double y) {
    const Robustness r = *robustness_of_fit(frame, box(0, 0, 1, 1), at_point(x, y));
    return r.ways.at(0).contacts.at(0);
  };
  using Kind = PlanarFeature::Kind;
  EXPECT_EQ(contact(7.75, 2).p, (PlanarFeature{Kind::edge, 1}));  // right side of the frame
  EXPECT_EQ(contact(2, 0.25).p, (PlanarFeature{Kind::edge, 0}));
  EXPECT_EQ(contact(0.25, 2).p, (PlanarFeature{Kind::edge, 3}));  // the last edge, which closes the ring
  EXPECT_EQ(contact(2.75, 4).p, (PlanarFeature{Kind::edge, 4}));  // left side of the hole
  EXPECT_EQ(contact(2.75, 2.75).p, (PlanarFeature{Kind::vertex, 4}));
  EXPECT_EQ(contact(5.25, 2.75).p, (PlanarFeature{Kind::vertex, 7}));
}

// All that is changed by up to r still fits, and by more than r it does not: with the exact discs' polygons.
TEST(Robustness, HoldsForShapesThatAreChangedByAsMuch) {
  std::mt19937_64 bits(23);
  int tried = 0;
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    const Result<Region> container = Region::create(of_kind(shapes::letter_u(9, 9, 2.5).data(), kind, bits)),
                         part = Region::create(of_kind(shapes::star(5, 0.25, 0.5).data(), kind, bits));
    if (!container || !part) continue;
    const RobustFit best = *most_robust_fit(*container, *part);
    ASSERT_TRUE(best.fits);
    const Robustness there = *robustness_of_fit(*container, *part, best.at);
    EXPECT_EQ(there.squared, best.squared);
    EXPECT_GE(best.at_most, best.radius);
    const auto fits_when_changed_by = [&](double r) {
      const Rational exact = *Rational::of(r);
      const Region smaller = to_region(*GrowingDisc(*container).eroded_at(exact), r * 1e-6, DiscBound::outside)->region;
      const Region larger = to_region(*GrowingDisc(*part).sum_at(exact), r * 1e-6, DiscBound::inside)->region;
      return !erode(smaller, larger)->parts.empty();
    };
    EXPECT_TRUE(fits_when_changed_by(best.radius * 0.9999));
    EXPECT_FALSE(fits_when_changed_by(best.at_most * 1.0001));
    ++tried;
  }
  EXPECT_GE(tried, 4);
}

TEST(Robustness, TheMostRobustFitIsNoWorseThanOthers) {
  const RobustFit rectangle = *most_robust_fit(box(0, 0, 10, 6), box(0, 0, 4, 2));
  EXPECT_TRUE(rectangle.exact);
  EXPECT_EQ(rectangle.squared, ratio(1));  // the inner fit is 6 x 4
  EXPECT_FALSE(most_robust_fit(box(0, 0, 3, 3), box(0, 0, 4, 2))->fits);
  const RobustFit tight = *most_robust_fit(box(0, 0, 4, 6), box(0, 0, 4, 2));
  EXPECT_TRUE(tight.fits);
  EXPECT_EQ(tight.radius, 0);
  EXPECT_TRUE(robustness_of_fit(box(0, 0, 4, 6), box(0, 0, 4, 2), tight.at)->holds);
  Random random(24);
  int fit = 0;
  for (int round = 0; round < rounds(30); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Region container = small_region(random, 8), part = small_region(random, 2);
    const RobustFit best = *most_robust_fit(container, part);
    if (!best.fits) continue;
    ++fit;
    EXPECT_EQ(robustness_of_fit(container, part, best.at)->squared, best.squared);
    for (const RationalPoint& at : positions_to_try(random, 0, 7, 20))
      EXPECT_LE(robustness_of_fit(container, part, at)->radius, best.at_most * (1 + 1e-12));
  }
  EXPECT_GT(fit, 5);
}

TEST(FitStack, AddsUpTolerancesEdgeByEdge) {
  const Region container = box(0, 0, 10, 6), part = box(0, 0, 4, 2);
  const Tolerance of_container[] = {{0.25, -0.125}}, of_part[] = {{0.0625, -0.5}};
  const FitStack stack = *fit_stack(container, of_container, part, of_part, at_point(5, 1));
  EXPECT_TRUE(stack.fits);
  ASSERT_EQ(stack.rows.size(), 4u);
  // From the bottom 1, from the right 1, from the top 3, from the left 5.
  const double nominal[] = {1, 1, 3, 5};
  const std::uint32_t edges[] = {0, 1, 2, 3};
  for (std::size_t k = 0; k < 4; ++k) {
    const FitStackRow& row = stack.rows[k];
    EXPECT_EQ(row.container, (PlanarFeature{PlanarFeature::Kind::edge, edges[k]}));
    EXPECT_EQ(row.part, (PlanarFeature{PlanarFeature::Kind::edge, edges[k]}));
    EXPECT_EQ(row.nominal, nominal[k]);
    EXPECT_EQ(row.squared, *Rational::of(nominal[k] * nominal[k]));
    EXPECT_EQ(row.least, nominal[k] - 0.125 - 0.0625);
    EXPECT_EQ(row.most, nominal[k] + 0.25 + 0.5);
    EXPECT_EQ(row.of_container, 0.375);
    EXPECT_EQ(row.of_part, 0.5625);
  }
  // A tolerance of one edge alone moves that row to the front.
  std::vector<Tolerance> each(4);
  each[3] = {0, -4.5};
  const FitStack one = *fit_stack(container, each, part, std::vector<Tolerance>(4), at_point(5, 1));
  EXPECT_EQ(one.rows[0].container.index, 3u);
  EXPECT_EQ(one.rows[0].least, 0.5);
  EXPECT_EQ(one.rows[0].of_part, 0);
  EXPECT_FALSE(fit_stack(container, of_container, part, of_part, at_point(7, 1))->fits);
}

// No variant of the bands has less clearance than the first row says, and where corners do not matter one has that.
TEST(FitStack, NoVariantHasLess) {
  Random random(25);
  int tried = 0;
  for (int round = 0; round < rounds(120) && tried < rounds(25); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Region container = small_region(random, 8), part = small_region(random, 2);
    const RobustFit best = *most_robust_fit(container, part);
    if (!best.fits || best.radius < 0.05) continue;
    ++tried;
    const double u = best.radius / 4, v = best.radius / 3;
    const Tolerance of_container[] = {{v, -u, 256}}, of_part[] = {{v, -u, 256}};
    const FitStack stack = *fit_stack(container, of_container, part, of_part, best.at);
    const Uncertain c = *Uncertain::of_band(container, of_container[0]), p = *Uncertain::of_band(part, of_part[0]);
    const double error = c.error() + p.error();
    EXPECT_NEAR(stack.rows[0].nominal, 2 * best.radius, 1e-12 * 16);
    // The outside of the smallest container is what it leaves of a frame.
    const PlanarSum outside = *difference(box(-20, -20, 30, 30), c.inner());
    const Uncertain wall = *Uncertain::between(outside, outside);
    const UncertainClearance left = *clearance(wall, p, best.at);
    EXPECT_GE(left.least_signed(), stack.rows[0].least - 2 * error);
    EXPECT_LE(left.least_signed(), stack.rows[0].least + 1e-9);
  }
  EXPECT_GT(tried, 5);
}

TEST(FitStack, RefusesTolerancesThatItCannotUse) {
  const Region container = box(0, 0, 10, 6), part = box(0, 0, 4, 2);
  const std::vector<Tolerance> one(1), three(3), upside{{-1, 1}};
  EXPECT_EQ(fit_stack(container, three, part, one, {}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(fit_stack(container, one, part, three, {}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(fit_stack(container, one, part, upside, {}).error().code, ErrorCode::out_of_range);
  const Region line = *Region::create({{}, {{{0, 0}, {1, 0}}}, {}});
  EXPECT_EQ(robustness_of_fit(container, line, {}).error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum::oracles
