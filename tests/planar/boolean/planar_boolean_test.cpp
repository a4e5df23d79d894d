// Boolean operations against membership by definition and their laws, exactly.
#include "dymsum/planar_boolean.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/exact_shape.h"
#include "oracles/pair_text.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/position/exact_source.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kSeed = 20261129;

int times(const char* name, int usual) {
  const char* queried = std::getenv(name);
  return queried != nullptr ? std::atoi(queried) : usual;
}

Region made(const RegionData& data) {
  Result<Region> region = Region::create(data);
  if (!region.ok()) throw std::runtime_error(region.error().to_string() + "\n" + to_wkt(data));
  return *std::move(region);
}

SumOptions with(Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  return options;
}

/// A result with what it is by definition.
struct Evaluated {
  PlanarSum set;
  BooleanExpression expression;
};

Evaluated leaf(const RegionData& region, std::size_t k, Semantics semantics) {
  const Region only = made(region);
  const std::array<PlanarOperand, 1> sets{only};
  return {united(sets, with(semantics)).value(), [k](const std::vector<ClosedAndOpen>& in) { return in[k]; }};
}

/// By index: |, &, -, ^.
Evaluated combined(int operation, const Evaluated& a, const Evaluated& b, Semantics semantics) {
  const SumOptions options = with(semantics);
  const BooleanExpression f = a.expression, g = b.expression;
  const auto both = [](ClosedAndOpen x, ClosedAndOpen y) {
    return ClosedAndOpen{x.closed && y.closed, x.open && y.open};
  };
  const auto either = [](ClosedAndOpen x, ClosedAndOpen y) {
    return ClosedAndOpen{x.closed || y.closed, x.open || y.open};
  };
  const auto no = [](ClosedAndOpen x) { return ClosedAndOpen{!x.open, !x.closed}; };
  switch (operation) {
    case 0:
      return {united(a.set, b.set, options).value(), [=](const auto& in) { return either(f(in), g(in)); }};
    case 1:
      return {intersection(a.set, b.set, options).value(), [=](const auto& in) { return both(f(in), g(in)); }};
    case 2:
      return {difference(a.set, b.set, options).value(), [=](const auto& in) { return both(f(in), no(g(in))); }};
    default:
      return {symmetric_difference(a.set, b.set, options).value(),
              [=](const auto& in) { return either(both(f(in), no(g(in))), both(g(in), no(f(in)))); }};
  }
}

/// A random expression of so many operations over the inputs, some of them several times.
Evaluated random_expression(const std::vector<RegionData>& inputs, int operations, Semantics semantics,
                            Random& random) {
  if (operations == 0) {
    const std::size_t k = static_cast<std::size_t>(random.below(static_cast<int>(inputs.size())));
    return leaf(inputs[k], k, semantics);
  }
  const int left = random.below(operations);
  const Evaluated a = random_expression(inputs, left, semantics, random),
                  b = random_expression(inputs, operations - 1 - left, semantics, random);
  return combined(random.below(4), a, b, semantics);
}

TEST(PlanarBoolean, expressions_on_tiny_grids_are_what_membership_says) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::size_t tight = 0, parts = 0;
  const int count = times("DYMSUM_FUZZ_BOOLEAN", 400);
  for (int k = 0; k < count; ++k) {
    Random random(kSeed + static_cast<std::uint64_t>(k));
    std::vector<RegionData> inputs;
    for (int i = 2 + random.below(2); i > 0; --i)
      inputs.push_back(k % 2 == 0 ? random_parts(random, 4) : random_region(random, 4));
    const Semantics semantics = std::array{Semantics::closed, Semantics::open, Semantics::regular}[random.next() % 3];
    const Evaluated result = random_expression(inputs, 1 + random.below(k % 10 == 0 ? 10 : 3), semantics, random);
    std::string trace =
        "expression " + std::to_string(k) + ", semantics " + std::to_string(static_cast<int>(semantics));
    for (const RegionData& input : inputs) trace += "\n" + to_wkt(input);
    SCOPED_TRACE(trace);
    ASSERT_EQ(check_boolean(inputs, result.expression, semantics, result.set), "");
    tight += result.set.tight_points.size() + result.set.tight_segments.size();
    parts += result.set.parts.size();
  }
  EXPECT_GT(tight, static_cast<std::size_t>(count) / 8);
  EXPECT_GT(parts, static_cast<std::size_t>(count) / 2);
}

TEST(PlanarBoolean, of_every_kind_of_coordinates_has_the_laws) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int k = 0; k < times("DYMSUM_FUZZ_BOOLEAN", 40); ++k) {
      Random random(kSeed + 7 * static_cast<std::uint64_t>(k));
      std::mt19937_64 noise(kSeed);
      const auto drawn = [&] { return Region::create(of_kind(random_parts(random, 6), kind, noise)); };
      const Result<Region> a = drawn(), b = drawn(), c = drawn();
      if (!a || !b || !c) continue;  // rounding has spoilt a shape that touched itself
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(k));
      const SumOptions options = with(Semantics::regular);
      const auto area_of = [](const PlanarSum& sum) { return sum.area_exact(); };
      const std::array<PlanarOperand, 1> only_a{*a}, only_b{*b};
      const PlanarSum all = united(only_a, options).value(), other = united(only_b, options).value(),
                      either = united(*a, *b, options).value(), both = intersection(*a, *b, options).value(),
                      left = difference(*a, *b, options).value(), right = difference(*b, *a, options).value(),
                      one = symmetric_difference(*a, *b, options).value();
      const auto big = [&](const PlanarSum& s) { return exact::BigRational(area_of(s).to_string()); };
      EXPECT_EQ(big(either) + big(both), big(all) + big(other));
      EXPECT_EQ(big(left) + big(both), big(all));
      EXPECT_EQ(big(left) + big(right), big(one));
      EXPECT_TRUE(united(left, both, options).value() == all);
      EXPECT_TRUE(difference(either, both, options).value() == one);
      EXPECT_TRUE(intersection(either, *a, options).value() == all) << "absorption";
      EXPECT_TRUE(united(both, *a, options).value() == all) << "absorption";
      EXPECT_TRUE(intersection(*c, either, options).value() ==
                  united(intersection(*c, *a, options).value(), intersection(*c, *b, options).value(), options).value())
          << "distribution";
      EXPECT_TRUE(
          difference(*c, either, options).value() ==
          intersection(difference(*c, *a, options).value(), difference(*c, *b, options).value(), options).value())
          << "De Morgan";
      EXPECT_TRUE(united(united(*a, *b, options).value(), *c, options).value() ==
                  united(*a, united(*b, *c, options).value(), options).value());
      EXPECT_TRUE(united(*a, *b).value() == union_of({*a, *b}).value()) << "with tight features";
    }
}

TEST(PlanarBoolean, closed_sets_have_an_edge_in_common_and_open_ones_leave_it_out) {
  const Region a = shapes::rectangle(0, 0, 2, 2), b = shapes::rectangle(2, 0, 4, 2), c = shapes::rectangle(4, 2, 5, 3);
  const PlanarSum edge = intersection(a, b).value();
  EXPECT_TRUE(edge.parts.empty());
  ASSERT_EQ(edge.segments.size(), 1u);
  EXPECT_EQ(edge.segments[0].from.at, (Point{2, 0}));
  EXPECT_EQ(edge.segments[0].to.at, (Point{2, 2}));
  EXPECT_EQ(edge.tight_segments.size(), 1u);
  const PlanarSum corner = intersection(b, c).value();
  ASSERT_EQ(corner.points.size(), 1u);
  EXPECT_EQ(corner.points[0].at, (Point{4, 2}));
  const PlanarSum open = united(a, b, with(Semantics::open)).value();
  EXPECT_EQ(open.parts.size(), 1u);
  EXPECT_EQ(open.tight_segments.size(), 1u);
  EXPECT_TRUE(united(a, b).value() == union_of({a, b}).value());
  EXPECT_TRUE(united(a, b).value().segments.empty());
  EXPECT_TRUE(intersection(a, b, with(Semantics::open)).value().segments.empty());
  const PlanarSum regular = intersection(a, b, with(Semantics::regular)).value();
  EXPECT_TRUE(regular.segments.empty() && regular.tight_segments.empty());
}

TEST(PlanarBoolean, what_is_taken_away_of_a_closed_set_is_open) {
  // Where a slot is exactly as wide as what fills it, its end stays as a segment.
  const Region whole = shapes::rectangle(0, 0, 4, 4), slot = shapes::rectangle(-1, -1, 5, 3),
               rest = shapes::rectangle(-1, 3, 5, 5);
  const PlanarSum left = difference(difference(whole, slot).value(), rest).value();
  EXPECT_TRUE(left.parts.empty());
  ASSERT_EQ(left.segments.size(), 1u);
  EXPECT_EQ(left.segments[0].from.at, (Point{0, 3}));
  EXPECT_EQ(left.segments[0].to.at, (Point{4, 3}));
}

TEST(PlanarBoolean, crossings_of_results_are_crossed_again_without_rounding) {
  // Thirds and sevenths are no doubles.
  const Region a = made({{{{{0, 0}, {7, 1}, {1, 7}}, {}}}, {}, {}}),
               b = made({{{{{6, 6}, {-1, 5}, {5, -1}}, {}}}, {}, {}}),
               c = made({{{{{3, -2}, {4, 9}, {2, 9}}, {}}}, {}, {}});
  const SumOptions regular = with(Semantics::regular);
  const PlanarSum both = intersection(a, b, regular).value(), cut = difference(both, c, regular).value(),
                  back = united(cut, intersection(both, c, regular).value(), regular).value();
  EXPECT_TRUE(back == both);
  for (const SumVertex& v : cut.parts[0].outer.vertices) EXPECT_EQ(v.in.q, 0u);
  EXPECT_EQ(cut.stats.tier_bits, both.stats.tier_bits);
}

TEST(PlanarBoolean, contacts_name_edges_of_the_regions_in_their_order) {
  const Region a = shapes::rectangle(0, 0, 3, 3), b = shapes::rectangle(1, 1, 5, 2);
  const PlanarSum left = difference(a, b).value();
  const auto edge_at = [](std::uint32_t p) {
    const std::array<Point, 8> v{Point{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {5, 1}, {5, 2}, {1, 2}};
    const std::uint32_t ring = p / 4 * 4;
    return std::array{v[p], v[ring + (p - ring + 1) % 4]};
  };
  std::size_t taken = 0, corners = 0;
  ASSERT_EQ(left.parts.size(), 1u);
  for (const SumVertex& v : left.parts[0].outer.vertices) {
    for (const Contact& c : {v.in, v.out}) {
      ASSERT_EQ(c.kind, Contact::Kind::edge_of_p);
      const auto [from, to] = edge_at(c.p);
      EXPECT_EQ((to.x - from.x) * (v.at.y - from.y), (to.y - from.y) * (v.at.x - from.x));
      taken += c.p >= 4;
    }
    corners += v.corner_p != SumVertex::kNone;
  }
  EXPECT_EQ(taken, 6u) << "three edges of the slot, each at both ends";
  EXPECT_EQ(corners, 6u) << "two vertices are crossings";
}

TEST(PlanarBoolean, results_of_other_kinds_are_operands) {
  const Region a = shapes::rectangle(0, 0, 4, 4), b = shapes::rectangle(0, 0, 1, 1);
  const PlanarSum sum = minkowski_sum(a, b).value(), room = erode(a, b).value();
  EXPECT_EQ(difference(sum, a).value().area(), 9);
  EXPECT_EQ(symmetric_difference(sum, room).value().area(), 16);
  EXPECT_NE(difference(sum, a).value().stats.tier_bits, 0) << "all vertices are doubles";
  const Region up = made({{{{{0, 0}, {7, 1}, {1, 7}}, {}}}, {}, {}}),
               down = made({{{{{3, -2}, {4, 9}, {2, 9}}, {}}}, {}, {}});
  const PlanarSum crossed = union_of({up, down}).value(), left = difference(crossed, a).value();
  EXPECT_TRUE(left == difference(united(up, down).value(), a).value());
  EXPECT_EQ(left.stats.tier_bits, 0);
  const PlanarSum exact_fit = erode(a, a).value();
  EXPECT_EQ(united(a, exact_fit).value().area(), 16);
  EXPECT_EQ(united(a, exact_fit, with(Semantics::regular)).value().area(), 16);
}

TEST(PlanarBoolean, exact_fits_of_an_erosion_stay_where_nothing_is_taken_away) {
  // A slot in which a peg fits exactly along a segment, less what another peg takes: what is left of the segment.
  const Region slot = shapes::rectangle(0, 0, 10, 1), peg = shapes::rectangle(0, 0, 2, 1);
  const PlanarSum fit = erode(slot, peg).value(), taken = nfp(peg, peg).value();
  ASSERT_EQ(fit.segments.size(), 1u);
  const PlanarSum left = difference(fit, taken).value();
  EXPECT_TRUE(left.parts.empty());
  ASSERT_EQ(left.segments.size(), 1u);
  EXPECT_EQ(left.segments[0].from.at, (Point{2, 0}));
  EXPECT_EQ(left.segments[0].to.at, (Point{8, 0}));
  const Region far = made({{{{{8, 0}, {10, 0}, {10, 1}, {8, 1}}, {}}}, {}, {}});
  const PlanarSum rest = difference(left, nfp(far, peg).value()).value();
  ASSERT_EQ(rest.segments.size(), 1u);
  EXPECT_EQ(rest.segments[0].to.at, (Point{6, 0}));
  // A hole that fits at one point, and one that something covers.
  const PlanarSum point = erode(peg, peg).value();
  ASSERT_EQ(point.points.size(), 1u);
  EXPECT_EQ(united(point, point).value(), point);
  EXPECT_EQ(intersection(point, slot).value().points.size(), 1u) << "on an edge of a closed set";
  EXPECT_TRUE(intersection(point, slot, with(Semantics::open)).value().points.empty());
  EXPECT_TRUE(difference(point, shapes::rectangle(-1, -1, 1, 1)).value().points.empty());
  EXPECT_EQ(difference(point, shapes::rectangle(0, -1, 1, 1)).value().points.size(), 1u)
      << "what is taken away is open";
  // Of crossings: thirds are no doubles.
  const Region tent = made({{{{{0, 0}, {3, 0}, {1, 1}}, {}}}, {}, {}});
  const PlanarSum tip = erode(minkowski_sum(tent, tent).value(), minkowski_sum(tent, tent).value()).value();
  ASSERT_EQ(tip.points.size(), 1u);
  EXPECT_EQ(difference(tip, tent).value().points.size(), 1u);
  EXPECT_TRUE(difference(tip, shapes::rectangle(-1, -1, 1, 1)).value().points.empty());
}

TEST(PlanarBoolean, lines_and_points_are_sets_without_interior) {
  const Region a = shapes::rectangle(0, 0, 4, 4), line = made({{}, {{{-1, 1}, {5, 1}}}, {}}),
               cross = made({{}, {{{1, -1}, {1, 5}}}, {}}), dots = made({{}, {}, {{2, 2}, {9, 9}, {4, 1}}});
  const PlanarSum out = difference(line, a).value();
  ASSERT_EQ(out.segments.size(), 2u);
  EXPECT_EQ(out.segments[0].to.at, (Point{0, 1}));
  EXPECT_EQ(intersection(line, a).value().segments.size(), 1u);
  EXPECT_EQ(intersection(line, cross).value().points.size(), 1u);
  EXPECT_EQ(united(a, dots).value().points.size(), 1u);
  EXPECT_EQ(intersection(a, dots).value().points.size(), 2u);
  EXPECT_EQ(intersection(line, dots).value().points.size(), 1u);
  EXPECT_EQ(difference(dots, a).value().points.size(), 2u) << "what is taken away is open: the one on the edge stays";
  const PlanarSum cut = difference(a, line, with(Semantics::open)).value();
  EXPECT_EQ(cut.tight_segments.size(), 1u) << "of an open set a closed line is taken away";
  EXPECT_EQ(difference(a, dots, with(Semantics::open)).value().tight_points.size(), 1u);
  const Region one = made({{}, {}, {{3, 0.5}}}), zero = made({{}, {}, {{0, 0}}});
  EXPECT_EQ(united(one, one).value().points.size(), 1u);
  EXPECT_EQ(united(one, zero).value().points.size(), 2u);
  EXPECT_TRUE(intersection(one, zero).value().points.empty());
  EXPECT_EQ(united(zero, zero).value().points[0].at, (Point{0, 0}));
}

TEST(PlanarBoolean, meetings_count_before_they_are_made) {
  // Lines through one position meet in pairs, tens of thousands of them.
  RegionData lines;
  for (int k = 0; k < 300; ++k)
    lines.polylines.push_back(
        {{-1000, static_cast<double>(2 * k - 300)}, {0, 0}, {1000, static_cast<double>(301 - 2 * k)}});
  const Region fan = made(lines);
  SumOptions little;
  little.memory = std::uint64_t{1} << 20;
  EXPECT_EQ(united(fan, fan, little).error().code, ErrorCode::out_of_memory);
  EXPECT_GT(united(shapes::rectangle(0, 0, 1, 1), fan).value().stats.peak_bytes, little.memory);
}

TEST(PlanarBoolean, nothing_and_too_little) {
  EXPECT_TRUE(united({}).value().parts.empty());
  EXPECT_EQ(intersection(std::span<const PlanarOperand>{}).error().code, ErrorCode::out_of_range);
  const Region a = shapes::rectangle(0, 0, 1, 1), none;
  EXPECT_TRUE(intersection(a, none).value().parts.empty());
  EXPECT_EQ(difference(a, none).value().area(), 1);
  EXPECT_TRUE(difference(none, a).value().parts.empty());
  EXPECT_TRUE(difference(a, a).value().parts.empty());
  EXPECT_EQ(difference(a, a).value().segments.size(), 4u) << "the boundary of what is taken away as an open set stays";
  const Region line = made({{}, {{{0, 0}, {1, 1}}}, {}});
  EXPECT_EQ(united(a, line).value().area(), 1);
  EXPECT_EQ(united(a, line, with(Semantics::regular)).value().area(), 1);
  const PlanarSum nothing = united(none, none).value();
  EXPECT_NE(sum_to_json(nothing), "") << "without any position";
  EXPECT_EQ(united(nothing, a).value().area(), 1);
  SumOptions stop;
  stop.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(united(a, a, stop).error().code, ErrorCode::cancelled);
}

TEST(PlanarFill, of_a_pentagram_and_of_rings_that_lie_on_each_other) {
  const RegionData star{{{{{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}, {}}}, {}, {}};
  const PlanarSum whole = filled(star, Fill::positive).value(), odd = filled(star, Fill::even_odd).value();
  ASSERT_EQ(whole.parts.size(), 1u);
  EXPECT_EQ(whole.parts[0].outer.vertices.size(), 10u);
  EXPECT_EQ(odd.parts.size(), 5u);
  RegionData back = star;
  std::reverse(back.parts[0].outer.begin(), back.parts[0].outer.end());
  EXPECT_TRUE(filled(back, Fill::positive).value().parts.empty());
  EXPECT_TRUE(filled(back, Fill::nonzero).value() == whole);
  const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(filled({{{square, {}}, {square, {}}}, {}, {}}, Fill::even_odd).value().parts.empty());
  EXPECT_EQ(filled({{{square, {}}, {square, {}}}, {}, {}}, Fill::positive).value().area(), 1);
  EXPECT_EQ(
      filled({{{{{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 0}, {2, 2}, {0, 2}}, {}}}, {}, {}}, Fill::positive).value().area(),
      4)
      << "repeated vertices and spikes";
  EXPECT_EQ(filled({{{{{0, 0}, {1, NAN}, {1, 1}}, {}}}, {}, {}}, Fill::positive).error().code, ErrorCode::not_finite);
}

/// How often a ring goes around a position off it, by the definition: signed crossings of a ray.
int winding(const Ring& ring, double x, double y) {
  int w = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const bool up = a.y <= y && b.y > y, down = b.y <= y && a.y > y;
    const double side = (b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y);
    if (up && side > 0) ++w;
    if (down && side < 0) --w;
  }
  return w;
}

TEST(PlanarFill, of_random_rings_is_inside_where_their_windings_say_so) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::size_t inside = 0, outside = 0;
  for (int k = 0; k < times("DYMSUM_FUZZ_BOOLEAN", 150); ++k) {
    Random random(kSeed + static_cast<std::uint64_t>(k));
    RegionData rings;
    for (int r = 1 + random.below(3); r > 0; --r) {
      Ring& ring = rings.parts.emplace_back().outer;
      for (int n = 3 + random.below(8); n > 0; --n)
        ring.push_back({static_cast<double>(random.below(7)), static_cast<double>(random.below(7))});
    }
    for (const Fill fill : {Fill::positive, Fill::nonzero, Fill::even_odd}) {
      const PlanarSum set = filled(rings, fill, with(Semantics::regular)).value();
      const Region region = set.rounded_with_repair().value().region;
      for (int s = 0; s < 200; ++s) {
        // Off all lines between grid points by more than rounding moves them.
        const double x = (random.below(7000) + 0.318) / 1000, y = (random.below(7000) + 0.577) / 1000;
        int w = 0;
        for (const Part& part : rings.parts) w += winding(part.outer, x, y);
        const bool wanted = fill == Fill::positive ? w > 0 : fill == Fill::nonzero ? w != 0 : (w & 1) != 0;
        const Region origin = made({{}, {}, {Point{0, 0}}});
        ASSERT_EQ(contains(region, origin, {x, y}), wanted) << "rings " << k << " at " << x << " " << y;
        ++(wanted ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(outside, 1000u);
}

}  // namespace
}  // namespace dymsum::oracles
