// Points located in a sum, against the answer one by one and against membership by definition.
#include "dymsum/sum_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/numbers.h"
#include "oracles/pair_text.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"

namespace dymsum {
namespace {

using oracles::Big;

constexpr std::uint64_t kLocatorSeed = 271828;
constexpr Semantics kSemantics[] = {Semantics::closed, Semantics::open, Semantics::regular};

PlanarSum sum_with(const Region& p, const Region& q, Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  return minkowski_sum(p, q, options).value();
}

Rational fraction(std::int64_t numerator, std::int64_t denominator) {
  return Rational::of(numerator, denominator).value();
}

RationalPoint between(const RationalPoint& a, const RationalPoint& b, const Rational& t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Vertices, points inside edges and tight features, and what is a hair beside each of them.
std::vector<RationalPoint> positions_of(const PlanarSum& sum) {
  std::vector<RationalPoint> positions;
  const auto add = [&](const SumVertex& from, const SumVertex& to) {
    const RationalPoint a = sum.exact(from), b = sum.exact(to);
    for (const Rational& t : {Rational(0), fraction(1, 3), fraction(1, 2)}) positions.push_back(between(a, b, t));
  };
  const auto add_ring = [&](const SumRing& ring) {
    for (std::size_t k = 0; k < ring.vertices.size(); ++k)
      add(ring.vertices[k], ring.vertices[(k + 1) % ring.vertices.size()]);
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  for (const auto* segments : {&sum.segments, &sum.tight_segments})
    for (const SumSegment& s : *segments) {
      add(s.from, s.to);
      positions.push_back(sum.exact(s.to));
    }
  for (const auto* points : {&sum.points, &sum.tight_points})
    for (const SumVertex& v : *points) positions.push_back(sum.exact(v));
  const std::size_t on_features = positions.size();
  const Rational hair = fraction(1, 1000000007);
  for (std::size_t k = 0; k < on_features; ++k) {
    const RationalPoint z = positions[k];
    if (k % 2 == 0) positions.push_back({z.x + hair, z.y});
    if (k % 2 == 1) positions.push_back({z.x - hair, z.y - hair * hair});
    if (k % 3 == 0) positions.push_back({z.x, z.y + hair});
  }
  return positions;
}

oracles::Pt<Big> big(const RationalPoint& z) {
  return {oracles::from_digits<Big>(z.x.numerator(), z.x.denominator()),
          oracles::from_digits<Big>(z.y.numerator(), z.y.denominator())};
}

TEST(SumLocator, equals_membership_by_definition_on_the_features_of_tiny_sums) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kLocatorSeed));
  int boundary = 0, inside = 0, outside = 0, tight = 0, fractions = 0;
  for (int k = 0; k < oracles::rounds(160); ++k) {
    oracles::Random random(kLocatorSeed + static_cast<std::uint64_t>(k));
    const auto [dp, dq] = oracles::random_pair(random, 2 + random.below(5));
    const Region p = Region::create(dp).value(), q = Region::create(dq).value();
    const oracles::Membership<Big> member(dp, dq);
    const PlanarSum closed_sum = sum_with(p, q, Semantics::closed), open_sum = sum_with(p, q, Semantics::open);
    const SumLocator closed(closed_sum, Semantics::closed), open(open_sum, Semantics::open),
        regular(sum_with(p, q, Semantics::regular), Semantics::regular);
    std::vector<RationalPoint> positions = positions_of(closed_sum);
    if (positions.size() > 90) positions.resize(90);
    for (const RationalPoint& z : positions) {
      const bool meets = member.meets(big(z)), overlaps = member.overlaps(big(z));
      const std::string evidence = z.x.to_string() + " " + z.y.to_string() + "\n" + oracles::to_text(dp, dq);
      ASSERT_EQ(closed.contains_rational(z), meets) << evidence;
      ASSERT_EQ(open.contains_rational(z), overlaps) << evidence;
      ASSERT_TRUE(!member.meets_with_area(big(z)) || regular.contains_rational(z)) << evidence;
      ASSERT_TRUE(meets || !regular.contains_rational(z)) << evidence;
      boundary += meets && !overlaps;
      inside += overlaps;
      outside += !meets;
      fractions += !z.x.is_integer() && !z.y.is_integer();
    }
    tight += static_cast<int>(closed_sum.tight_segments.size() + closed_sum.tight_points.size());
  }
  EXPECT_GT(boundary, oracles::rounds(2000));
  EXPECT_GT(inside, oracles::rounds(500));
  EXPECT_GT(outside, oracles::rounds(500));
  EXPECT_GT(fractions, oracles::rounds(1000));
  EXPECT_GT(tight, oracles::rounds(20));
}

TEST(SumLocator, equals_contains_on_the_points_of_tiny_grids) {
  for (int k = 0; k < oracles::rounds(120); ++k) {
    oracles::Random random(kLocatorSeed + 1000 + static_cast<std::uint64_t>(k));
    const auto [dp, dq] = oracles::random_pair(random, 2 + random.below(5));
    const Region p = Region::create(dp).value(), q = Region::create(dq).value();
    const auto a = bounds(p), b = bounds(q);
    for (const Semantics semantics : kSemantics) {
      const SumLocator sum(sum_with(p, q, semantics), semantics);
      for (double x = a[0] + b[0] - 0.5; x <= a[2] + b[2] + 0.5; x += 0.5)
        for (double y = a[1] + b[1] - 0.5; y <= a[3] + b[3] + 0.5; y += 0.5)
          ASSERT_EQ(sum.contains({x, y}), contains(p, q, {x, y}, semantics))
              << x << " " << y << " semantics " << static_cast<int>(semantics) << "\n"
              << oracles::to_text(dp, dq);
    }
  }
}

TEST(SumLocator, equals_contains_at_free_coordinates) {
  oracles::Random random(kLocatorSeed);
  const Region shapes[] = {snapped_shapes::star(40, 0.7, 3.1), snapped_shapes::gear(12, 3, 4),
                           shapes::grate(4, 1.25, 0.3, 3), snapped_shapes::spiral(3, 24, 1, 0.3)};
  int inside = 0, queried = 0;
  for (const Region& p : shapes)
    for (const Region& q : shapes) {
      const auto a = bounds(p), b = bounds(q);
      std::vector<Point> points;
      for (int k = 0; k < oracles::rounds(60); ++k) {
        const double s = random.below(1 << 20) * 0x1p-20, t = random.below(1 << 20) * 0x1p-20;
        points.push_back(
            {a[0] + b[0] + s * (a[2] + b[2] - a[0] - b[0]), a[1] + b[1] + t * (a[3] + b[3] - a[1] - b[1])});
      }
      for (const Semantics semantics : kSemantics) {
        const SumLocator sum(sum_with(p, q, semantics), semantics);
        const std::vector<std::uint8_t> found = sum.contains_each(points, 2).value();
        for (std::size_t k = 0; k < points.size(); ++k)
          ASSERT_EQ(found[k] != 0, contains(p, q, points[k], semantics)) << points[k].x << " " << points[k].y;
        queried += static_cast<int>(points.size());
        inside += static_cast<int>(std::count(found.begin(), found.end(), 1));
      }
    }
  EXPECT_GT(inside, queried / 4);
  EXPECT_LT(inside, queried * 15 / 16);
}

// Positions nearer to each other than doubles are: what decides is exact, not the nearest double.
TEST(SumLocator, queries_progress_and_stops) {
  const Region square = shapes::rectangle(0, 0, 1, 1);
  const SumLocator sum(minkowski_sum(square, square).value());
  const std::vector<Point> points(200000, Point{1, 1});
  const std::vector<RationalPoint> exact(10000, RationalPoint{*Rational::of(1, 3), 1});
  std::vector<double> fractions;
  const Progress count = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  EXPECT_EQ(sum.contains_each(points, 1, count).value(), std::vector<std::uint8_t>(points.size(), 1));
  EXPECT_GE(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()) && fractions.back() <= 1);
  fractions.clear();
  EXPECT_EQ(sum.contains_each(exact, 2, count).value(), std::vector<std::uint8_t>(exact.size(), 1));
  EXPECT_GE(fractions.size(), 3u);
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_EQ(sum.contains_each(points, 1, stop).error().code, ErrorCode::cancelled);
  EXPECT_EQ(sum.contains_each(exact, 1, stop).error().code, ErrorCode::cancelled);
}

TEST(SumLocator, decides_what_doubles_cannot_hold) {
  const Region p = shapes::rectangle(0, 0, 0.1, 1), q = shapes::rectangle(0, 0, 0.2, 1);
  const SumLocator sum(minkowski_sum(p, q).value());
  EXPECT_FALSE(sum.contains({0.1 + 0.2, 1}));  // rounded up
  EXPECT_TRUE(sum.contains({std::nextafter(0.1 + 0.2, 0), 1}));
  const Rational corner = Rational::of(0.1).value() + Rational::of(0.2).value();
  EXPECT_TRUE(sum.contains_rational({corner, 2}));
  EXPECT_FALSE(sum.contains_rational({corner + Rational::parse("1e-300").value(), 2}));
  EXPECT_FALSE(sum.contains_rational({corner, 2 + Rational::parse("1e-300").value()}));
  const Region far = shapes::rectangle(0x1p60, 0x1p60, 0x1p60 + 0x1p10, 0x1p60 + 0x1p10),
               back = shapes::rectangle(-0x1p60, -0x1p60, -0x1p60 + 0x1p10, -0x1p60 + 0x1p10);
  const SumLocator near(minkowski_sum(far, back).value());
  EXPECT_TRUE(near.contains({0, 0}));
  EXPECT_FALSE(near.contains({-0x1p-1000, 1}));
  EXPECT_FALSE(near.contains({1, -0x1p-1000}));
  EXPECT_TRUE(near.contains({0x1p-1000, 0x1p-1000}));
}

// Cracks may cross each other; so may segments of a set without area.
TEST(SumLocator, finds_points_on_features_that_cross) {
  const Region windows =
      Region::create({{{{{0, 0}, {12, 0}, {12, 12}, {0, 12}}, {{{3, 5}, {3, 7}, {9, 7}, {9, 5}}}}}, {}, {}}).value();
  const Region peg = shapes::rectangle(-1, -1, 1, 1);
  const SumLocator slot(sum_with(windows, peg, Semantics::open), Semantics::open);
  EXPECT_FALSE(slot.contains({6, 6}));
  EXPECT_FALSE(slot.contains({8, 6}));
  EXPECT_TRUE(slot.contains({std::nextafter(8, 9), 6}));
  EXPECT_FALSE(slot.contains_rational({fraction(22, 3), 6}));
  EXPECT_TRUE(slot.contains({6, std::nextafter(6, 7)}));
  const Region cross = Region::create({{}, {{{0, 0}, {4, 4}}, {{0, 4}, {4, 0}}, {{0, 1}, {4, 1}}}, {}}).value();
  const Region origin = Region::create({{}, {}, {{0, 0}}}).value();
  const SumLocator lines(minkowski_sum(cross, origin).value());
  for (const Point z : {Point{2, 2}, Point{1, 1}, Point{3, 1}, Point{0.5, 1}, Point{0, 4}}) {
    EXPECT_TRUE(lines.contains(z)) << z.x << " " << z.y;
    EXPECT_FALSE(lines.contains({z.x, z.y + 0x1p-40})) << z.x << " " << z.y;
  }
}

TEST(SumLocator, nothing_in_an_empty_set_or_at_no_place) {
  const Region square = shapes::rectangle(0, 0, 1, 1), none;
  EXPECT_FALSE(SumLocator(minkowski_sum(square, none).value()).contains({0, 0}));
  const SumLocator sum(minkowski_sum(square, square).value());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(sum.contains({std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(sum.contains({1, kInfinity}));
  EXPECT_FALSE(sum.contains({-kInfinity, 1}));
  EXPECT_FALSE(sum.contains_rational({Rational::parse("1e400").value(), 1}));
  EXPECT_FALSE(sum.contains_rational({1, Rational::parse("-1e400").value()}));
  EXPECT_TRUE(sum.contains_rational({Rational::parse("1e-400").value(), 1}));
  EXPECT_FALSE(sum.contains_rational({Rational::parse("-1e-400").value(), 1}));
}

// Sums that the inner fits and frames of moving sums are, too.
TEST(SumLocator, of_an_inner_fit_without_freedom) {
  const SumLocator fit(erode(shapes::rectangle(0, 0, 3, 2), shapes::rectangle(0, 0, 1, 2)).value());
  EXPECT_TRUE(fit.contains({1, 0}));
  EXPECT_TRUE(fit.contains({2, 0}));
  EXPECT_TRUE(fit.contains_rational({fraction(1, 3), 0}));
  EXPECT_FALSE(fit.contains({1, 0x1p-1000}));
  EXPECT_FALSE(fit.contains({std::nextafter(2, 3), 0}));
}

std::vector<Point> lattice(double low, double high, double step) {
  std::vector<Point> points;
  for (double x = low; x <= high; x += step)
    for (double y = low; y <= high; y += step) points.push_back({x, y});
  return points;
}

TEST(ContainsEach, few_points_and_many_have_the_same_answers) {
  const Region p = snapped_shapes::star(9, 1, 4), q = shapes::letter_u(4, 4, 1);
  const std::vector<Point> many = lattice(-6, 9, 0.25);
  for (const Semantics semantics : kSemantics)
    for (const int threads : {1, 2}) {
      const std::vector<std::uint8_t> all = contains_each(p, q, many, semantics, threads).value();
      ASSERT_EQ(all.size(), many.size());
      for (std::size_t k = 0; k < many.size(); k += 37) {
        const auto few = std::span(many).subspan(k, std::min<std::size_t>(3, many.size() - k));
        const std::vector<std::uint8_t> some = contains_each(p, q, few, semantics, threads).value();
        for (std::size_t i = 0; i < few.size(); ++i) ASSERT_EQ(some[i], all[k + i]) << few[i].x << " " << few[i].y;
      }
    }
}

/// The stages that a call for so many points tells of.
std::vector<std::string> stages_of(std::size_t count) {
  std::vector<std::string> stages;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return true;
  };
  const Region p = snapped_shapes::star(30, 1, 4), q = snapped_shapes::gear(20, 3, 4);
  EXPECT_TRUE(contains_each(p, q, std::vector<Point>(count, Point{1, 1}), Semantics::closed, 1, progress).ok());
  return stages;
}

TEST(ContainsEach, many_points_are_located_in_the_sum_and_few_are_not) {
  EXPECT_EQ(stages_of(3), std::vector<std::string>{"points"});
  const std::vector<std::string> stages = stages_of(100000);
  EXPECT_GT(stages.size(), 1u);  // those of a sum
  EXPECT_EQ(stages.back(), "points");
}

TEST(ContainsEach, at_fractions) {
  const Region triangle = shapes::rectangle(0, 0, 1, 1);
  const std::vector<RationalPoint> points = {{fraction(1, 3), fraction(2, 3)}, {2, 2}, {fraction(7, 3), 1}};
  EXPECT_EQ(contains_each(triangle, triangle, points).value(), (std::vector<std::uint8_t>{1, 1, 0}));
  EXPECT_EQ(contains_each(triangle, triangle, points, Semantics::open).value(), (std::vector<std::uint8_t>{1, 0, 0}));
  EXPECT_EQ(contains_each(triangle, Region(), points).value(), (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(ContainsEach, is_cancelled_and_refuses_what_sums_refuse) {
  const Region p = snapped_shapes::star(30, 1, 4), huge = shapes::rectangle(0, 0, 0x1p1001, 1);
  for (const std::size_t count : {3, 100000}) {
    const std::vector<Point> points(count, Point{1, 1});
    const auto stopped =
        contains_each(p, p, points, Semantics::closed, 1, [](std::string_view, double) { return false; });
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
    const auto refused = contains_each(p, huge, points);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported_operand);
  }
  EXPECT_TRUE(contains_each(p, p, std::span<const Point>()).value().empty());
}

}  // namespace
}  // namespace dymsum
