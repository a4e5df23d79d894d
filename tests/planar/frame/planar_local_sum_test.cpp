// Planar local sums: the whole sum cut, whatever way they are found, in boxes and discs at random and critical
// positions, moving.
#include "dymsum/planar_local_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <type_traits>
#include "oracles/coordinate_kinds.h"

#include "dymsum/orientation_sum.h"
#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/clipped_sum.h"
#include "spatial/convex/setting.h"

namespace dymsum {
namespace {

using clipped_sum::Shape;
using oracles::Random;
using Where = PlanarLocalPart::Where;

PlanarLocalSum near_sum(const Region& p, const Region& q, LocalEngine engine = LocalEngine::updated) {
  PlanarLocalOptions options;
  options.engine = engine;
  return PlanarLocalSum::create(p, q, options).value();
}

/// With the tight features.
SumOptions open_sums() {
  SumOptions options;
  options.semantics = Semantics::open;
  return options;
}

Region region_of(RegionData data) { return Region::create(std::move(data)).value(); }

/// Boundaries end at sides of the box only (observation 5 of the thesis): elsewhere as many edges arrive as leave.
bool edges_end_at_sides(const PlanarLocalPart& part) {
  std::vector<int> surplus(part.vertices.size(), 0);
  for (const PlanarLocalPart::Edge& e : part.edges) ++surplus[e.from], --surplus[e.to];
  const clipped_sum::Position low = clipped_sum::position(part.box.low), high = clipped_sum::position(part.box.high);
  for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
    if (surplus[v] == 0) continue;
    const clipped_sum::Position at = clipped_sum::position(part.exact(v));
    if (at[0] != low[0] && at[0] != high[0] && at[1] != low[1] && at[1] != high[1]) return false;
  }
  return true;
}

std::string text(const PlanarBox& b) {
  char line[160];
  std::snprintf(line, sizeof line, "[%.17g, %.17g] x [%.17g, %.17g]", b.low.x, b.high.x, b.low.y, b.high.y);
  return line;
}

/// The engines side by side.
class Engines {
 public:
  Engines(const Region& p, const Region& q)
      : updated_(near_sum(p, q)),
        hierarchy_(near_sum(p, q, LocalEngine::hierarchy)),
        brute_(near_sum(p, q, LocalEngine::brute)) {}

  template <class Clip>
  PlanarLocalPart in(const Clip& clip, const PlanarPose& p, const PlanarPose& q, bool with_brute) {
    PlanarLocalPart part = updated_.in(clip, p, q).value();
    rebuilt += part.work.rebuilt, calls += 1, tests += part.work.collision_tests;
    EXPECT_TRUE(part == hierarchy_.in(clip, p, q).value()) << "hierarchy";
    if (with_brute) {
      EXPECT_TRUE(part == brute_.in(clip, p, q).value()) << "brute";
    }
    if constexpr (std::is_same_v<Clip, PlanarBox>) {
      EXPECT_TRUE(edges_end_at_sides(part)) << "ends";
    }
    EXPECT_EQ(part.where == Where::crossed, !part.vertices.empty());
    return part;
  }
  std::uint64_t rebuilt = 0, calls = 0, tests = 0;

 private:
  PlanarLocalSum updated_, hierarchy_, brute_;
};

/// Boxes about places of a sum: some end exactly at its vertices, some anywhere.
PlanarBox random_box(Random& random, const PlanarSum& sum) {
  std::vector<Point> at;
  for (const SumPart& part : sum.parts)
    for (const SumVertex& v : part.outer.vertices) at.push_back(v.at);
  for (const SumPart& part : sum.parts)
    for (const SumRing& hole : part.holes)
      for (const SumVertex& v : hole.vertices) at.push_back(v.at);
  for (const SumSegment& s : sum.tight_segments) at.push_back(s.from.at), at.push_back(s.to.at);
  for (const SumVertex& v : sum.tight_points) at.push_back(v.at);
  if (at.empty()) at.push_back({});
  const Point near = at[static_cast<std::size_t>(random.below(static_cast<int>(at.size())))];
  const auto span = [&](double v, double other) {
    double a = random.chance(50) ? v : v + random.below(9) / 4.0 - 1,
           b = random.chance(30) ? other : a + random.below(12) / 4.0 - 1;
    if (a == b) b = a + 0.5;
    return std::pair{std::min(a, b), std::max(a, b)};
  };
  const Point far = at[static_cast<std::size_t>(random.below(static_cast<int>(at.size())))];
  const auto [x0, x1] = span(near.x, far.x);
  const auto [y0, y1] = span(near.y, far.y);
  return {{x0, y0}, {x1, y1}};
}

PlanarDisc random_disc(Random& random, const PlanarBox& about) {
  return {{about.low.x + random.below(5) / 4.0 - 0.5, about.high.y + random.below(5) / 4.0 - 0.5},
          (1 + random.below(12)) / 4.0};
}

TEST(PlanarLocalSum, is_the_whole_sum_cut_in_random_boxes_and_discs_on_tiny_grids) {
  const std::uint64_t pairs = test::setting("DYMSUM_FUZZ_PAIRS", 700);
  Random random(test::setting("DYMSUM_FUZZ_SEED", 41));
  std::size_t crossed = 0, inside = 0, tight = 0, points = 0, positions = 0;
  for (std::uint64_t k = 0; k < pairs; ++k) {
    const oracles::Pair pair = oracles::random_pair(random, 3 + random.below(4));
    RegionData pd = pair.p, qd = pair.q;
    pd.polylines.clear(), pd.points.clear(), qd.polylines.clear(), qd.points.clear();
    if (pd.parts.empty() || qd.parts.empty()) continue;
    const Region p = region_of(pd), q = region_of(qd);
    const PlanarSum whole = minkowski_sum(p, q, open_sums()).value();
    Engines engines(p, q);
    for (int i = 0; i < 12; ++i, ++positions) {
      const PlanarBox box = random_box(random, whole);
      const PlanarLocalPart part = engines.in(box, {}, {}, i % 4 == 0);
      ASSERT_TRUE(clipped_sum::shape_of(part) == clipped_sum::cut(whole, box)) << "pair " << k << " in " << text(box);
      const PlanarDisc disc = random_disc(random, box);
      const PlanarLocalPart met = engines.in(disc, {}, {}, i % 4 == 1);
      ASSERT_TRUE(clipped_sum::shape_of(met) == clipped_sum::in_disc(clipped_sum::cut(whole, met.box), disc))
          << "pair " << k << " disc about " << disc.centre.x << ", " << disc.centre.y;
      if (part.where != Where::crossed) {
        const Point centre{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2};
        ASSERT_EQ(part.where == Where::inside, contains(p, q, centre, Semantics::open)) << k << text(box);
      }
      crossed += part.where == Where::crossed, inside += part.where == Where::inside;
      tight += !part.tight_segments.empty(), points += !part.tight_points.empty();
    }
    ASSERT_FALSE(HasFailure()) << "pair " << k;
  }
  std::printf("%zu places twice: %zu crossed, %zu inside, %zu with tight segments, %zu with tight points\n", positions,
              crossed, inside, tight, points);
  EXPECT_GT(crossed, positions / 3);
  EXPECT_GT(inside, positions / 100);
  EXPECT_GT(tight, positions / 200);
  EXPECT_GT(points, 0U);
}

TEST(PlanarLocalSum, of_coordinates_of_every_kind) {
  Random random(7314);
  std::mt19937_64 noise(7314);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int compared = 0;
    for (int k = 0; k < 30; ++k) {
      const oracles::Pair pair = oracles::random_pair(random, 3 + random.below(4));
      RegionData pd = of_kind(pair.p, kind, noise), qd = of_kind(pair.q, kind, noise);
      pd.polylines.clear(), pd.points.clear(), qd.polylines.clear(), qd.points.clear();
      const Result<Region> p = Region::create(pd), q = Region::create(qd);
      if (!p.ok() || !q.ok() || pd.parts.empty() || qd.parts.empty()) continue;
      const PlanarSum whole = minkowski_sum(*p, *q, open_sums()).value();
      Engines engines(*p, *q);
      for (int i = 0; i < 6; ++i, ++compared) {
        const PlanarBox box = random_box(random, whole);
        const PlanarLocalPart part = engines.in(box, {}, {}, i == 0);
        ASSERT_TRUE(clipped_sum::shape_of(part) == clipped_sum::cut(whole, box))
            << name_of(kind) << ", pair " << k << " in " << text(box);
      }
      ASSERT_FALSE(HasFailure()) << name_of(kind) << ", pair " << k;
    }
    EXPECT_GT(compared, 20) << name_of(kind);
  }
}

/// Combs of which no two lines are quite parallel, as those have that were turned in doubles, by angles down to
/// where lines of one operand are as near to each other: hundreds of crossings that only their lines distinguish.
TEST(PlanarLocalSum, thin_boxes_along_lines_that_nearly_coincide) {
  std::mt19937_64 noise(7315);
  const auto jittered = [&](const Region& region) {
    RegionData data = region.data();
    for (Part& part : data.parts)
      for (Point& v : part.outer) {
        const auto off = [&](double x) { return x / 3 + std::ldexp(static_cast<double>(noise() % 5) - 2, -51); };
        v = {off(v.x), off(v.y)};
      }
    return region_of(std::move(data));
  };
  Random random(7315);
  std::size_t edges = 0;
  for (const auto& [one, other] : {std::pair{shapes::comb(4, 2, 1, 3), shapes::comb(3, 2, 1, 3)},
                                   {shapes::comb(3, 2, 1, 3), shapes::letter_u(4, 3, 1)}}) {
    const Region p = jittered(one), q = jittered(other);
    Engines engines(p, q);
    for (const int bits : {0, 24, 40, 51, 54, 62}) {
      PlanarPose pose;
      if (bits != 0) pose.rotation = Orientation::of(1, std::int64_t{1} << bits).value();
      const PlanarSum whole = rotated_sum(p, q, pose.rotation, open_sums()).value();
      for (int i = 0; i < 8; ++i) {
        const PlanarBox at = random_box(random, whole);
        const double thin = 0x1p-17;
        const PlanarBox box = i % 2 == 0 ? PlanarBox{{at.low.x, at.low.y - thin}, {at.high.x, at.low.y + thin}}
                                         : PlanarBox{{at.low.x - thin, at.low.y}, {at.low.x + thin, at.high.y}};
        const PlanarLocalPart part = engines.in(box, pose, {}, i == 0);
        ASSERT_TRUE(clipped_sum::shape_of(part) == clipped_sum::cut(whole, box))
            << "2^-" << bits << " in " << text(box);
        edges += part.edges.size();
      }
      ASSERT_FALSE(HasFailure()) << "2^-" << bits;
    }
  }
  EXPECT_GT(edges, 100U);
}

TEST(PlanarLocalSum, follows_quarter_turns_and_scales_exactly) {
  const std::uint64_t moves = test::setting("DYMSUM_FUZZ_MOVES", 150);
  Random random(test::setting("DYMSUM_FUZZ_SEED", 5));
  const Region p = shapes::letter_u(4, 3, 1), q = shapes::letter_l(2, 2, 1);
  Engines engines(p, q);
  const auto random_pose = [&] {
    PlanarPose pose;
    const int quarter = random.below(4);
    pose.rotation = quarter == 2   ? Orientation::half_turn()
                    : quarter == 0 ? Orientation()
                                   : Orientation::of(quarter == 1 ? 1 : -1, 1).value();
    for (Scale& s : pose.scale) s = Scale::of(std::ldexp(1.0, random.below(3) - 1)).value();
    return std::pair{pose, quarter};
  };
  const auto moved = [&](const Region& region, const PlanarPose& pose, int quarter) {
    RegionData data = region.data();
    for (Part& part : data.parts)
      for (Point& v : part.outer) {
        v = {pose.scale[0].approx() * v.x, pose.scale[1].approx() * v.y};
        for (int k = 0; k < quarter; ++k) v = {-v.y, v.x};
      }
    return region_of(std::move(data));
  };
  for (std::uint64_t k = 0; k < moves; ++k) {
    const auto [p_pose, p_quarter] = random_pose();
    const auto [q_pose, q_quarter] = random_pose();
    const PlanarSum whole =
        minkowski_sum(moved(p, p_pose, p_quarter), moved(q, q_pose, q_quarter), open_sums()).value();
    const PlanarBox box = random_box(random, whole);
    const PlanarLocalPart part = engines.in(box, p_pose, q_pose, k % 5 == 0);
    ASSERT_TRUE(clipped_sum::shape_of(part) == clipped_sum::cut(whole, box)) << "move " << k << " in " << text(box);
  }
}

TEST(PlanarLocalSum, follows_a_turning_operand_and_updates_what_it_keeps) {
  const std::uint64_t frames = test::setting("DYMSUM_FUZZ_FRAMES", 60);
  const std::vector<std::pair<Region, Region>> pairs = {
      {snapped_shapes::gear(9, 2, 3), snapped_shapes::star(7, 0.75, 1.5)},
      {shapes::random_polygon(40, 2, 3), shapes::letter_l(0.5, 0.5, 0.125)},
      {shapes::grate(4, 2, 0.5, 6), shapes::rectangle(0, 0, 1.5, 1)}};
  for (const auto& [p, q] : pairs) {
    Random random(17);
    Engines engines(p, q);
    PlanarBox box;
    for (std::uint64_t k = 0; k < frames; ++k) {
      PlanarPose pose;
      pose.rotation = Orientation::nearest(0.013 * static_cast<double>(k), 0x1p-12).value();
      const PlanarSum whole = rotated_sum(p, q, pose.rotation, open_sums()).value();
      if (k % 10 == 0) box = random_box(random, whole);
      box.low.x += 1.0 / 64, box.high.x += 1.0 / 64;
      const PlanarLocalPart part = engines.in(box, pose, {}, k % 10 == 0);
      ASSERT_TRUE(clipped_sum::shape_of(part) == clipped_sum::cut(whole, box)) << "frame " << k << " in " << text(box);
    }
    EXPECT_LT(engines.rebuilt, engines.calls / 3) << "most frames update what was kept";
    EXPECT_GT(engines.rebuilt, 1U);
  }
}

TEST(PlanarLocalSum, both_operands_turn_against_each_other_as_one_does) {
  const Region p = snapped_shapes::gear(9, 2, 3), q = snapped_shapes::star(7, 0.75, 1.5);
  const Orientation by = Orientation::of(2, 7).value(), other = Orientation::of(-3, 11).value();
  // The box holds both whole: what lies in it is the sum itself, turned.
  const PlanarBox all{{-20, -20}, {20, 20}};
  PlanarLocalSum sum = near_sum(p, q);
  PlanarPose a, b, c;
  a.rotation = by * other, b.rotation = other, c.rotation = by;
  const PlanarLocalPart turned = sum.in(all, a, b).value(), first = sum.in(all, c, {}).value();
  ASSERT_EQ(turned.edges.size(), first.edges.size());
  const auto squares = [](const PlanarLocalPart& part) {
    std::multiset<std::string> list;
    for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
      const RationalPoint at = part.exact(v);
      list.insert((at.x * at.x + at.y * at.y).to_string());
    }
    return list;
  };
  EXPECT_EQ(squares(turned), squares(first));
}

TEST(PlanarLocalSum, tight_features_at_sides_of_the_box) {
  // A square hole of 1, and squares: a point where it fits, a segment where it slides.
  RegionData plate;
  plate.parts.push_back({{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, {{{0, 0}, {0, 1}, {3, 1}, {3, 0}}}});
  const Region p = region_of(plate), peg = shapes::rectangle(0, 0, 1, 1), long_peg = shapes::rectangle(0, 0, 3, 1);
  Engines slides(p, peg), fits(p, long_peg);
  const auto in = [](Engines& e, PlanarBox box) { return e.in(box, {}, {}, true); };
  EXPECT_EQ(in(slides, {{0, 0}, {2, 2}}).tight_segments.size(), 1U);  // y = 1, x from 1 to 3
  EXPECT_EQ(in(slides, {{0, 1}, {2, 2}}).tight_segments.size(), 1U);
  EXPECT_EQ(in(slides, {{0, 1}, {1, 2}}).where, Where::inside) << "only touches";
  EXPECT_EQ(in(fits, {{2, 0}, {3, 1}}).tight_points.size(), 1U) << "in a corner of the box";
  EXPECT_EQ(in(fits, {{2, 0}, {4, 2}}).tight_points.size(), 1U);
  EXPECT_EQ(in(fits, {{3.5, 0}, {4, 2}}).where, Where::inside);
  EXPECT_EQ(in(fits, {{20, 0}, {21, 2}}).where, Where::outside);
}

TEST(PlanarLocalSum, the_largest_and_smallest_boxes) {
  const Region square = shapes::rectangle(-1, -1, 1, 1);
  Engines sums(square, square);
  const auto edges = [&](PlanarBox box) { return sums.in(box, {}, {}, true).edges.size(); };
  EXPECT_EQ(edges({{-1e300, -1e300}, {1e300, 1e300}}), 4U);
  EXPECT_EQ(edges({{-2, -2}, {2, 2}}), 4U);
  EXPECT_EQ(edges({{2, 2}, {3, 3}}), 0U);
  EXPECT_EQ(edges({{0, 1}, {0x1p-200, 3}}), 1U);
  EXPECT_EQ(edges({{0, 0x1.fffffffffffffp0}, {0x1p-1060, 2}}), 1U);
  EXPECT_EQ(sums.in(PlanarBox{{-1, -1}, {1, 1}}, {}, {}, true).where, Where::inside);
  const double huge = 0x1p900, tiny = 0x1p-900;
  for (const double size : {huge, tiny}) {
    const Region large = shapes::rectangle(-size, -size, size, size);
    Engines scaled(large, large);
    EXPECT_EQ(scaled.in(PlanarBox{{0, 0}, {3 * size, 3 * size}}, {}, {}, true).edges.size(), 2U) << size;
  }
  Engines both(shapes::rectangle(-huge, -huge, huge, huge), square);
  EXPECT_EQ(both.in(PlanarBox{{0, 0}, {3 * huge, 3 * huge}}, {}, {}, true).edges.size(), 2U);
}

TEST(PlanarLocalSum, a_disc_takes_the_edges_that_it_meets_exactly) {
  const Region square = shapes::rectangle(-1, -1, 1, 1);
  PlanarLocalSum sum = near_sum(square, square);
  EXPECT_EQ(sum.in(PlanarDisc{{0, 3}, 1})->edges.size(), 1U) << "touches";
  EXPECT_EQ(sum.in(PlanarDisc{{0, 3}, 0x1.fffffffffffffp-1})->where, Where::outside);
  EXPECT_EQ(sum.in(PlanarDisc{{5, 6}, 5})->edges.size(), 2U) << "touches the corner (2, 2)";
  EXPECT_EQ(sum.in(PlanarDisc{{5, 6}, 0x1.3ffffffffffffp2})->where, Where::outside) << "its box does not";
  EXPECT_EQ(sum.in(PlanarDisc{{0, 0}, 1.5})->where, Where::inside);
  const PlanarBox rounded = bounding_box(PlanarDisc{{0.1, 0}, 0.7});
  EXPECT_LT(rounded.low.x, 0.1 - 0.7 + 1e-16);
  EXPECT_GE(rounded.high.x, 0.1 + 0.7);
}

TEST(PlanarLocalSum, asks_once_for_each_piece_of_the_boundary) {
  const Region p = snapped_shapes::gear(60, 9, 10), q = snapped_shapes::gear(60, 0.9, 1);
  PlanarLocalSum sum = near_sum(p, q), brute = near_sum(p, q, LocalEngine::brute);
  const PlanarDisc disc{{0, 10.5}, 1};
  const PlanarLocalPart part = sum.in(disc).value();
  EXPECT_EQ(part.where, Where::crossed);
  EXPECT_LT(part.work.collision_tests, 40U);
  EXPECT_LT(3 * part.work.segments, brute.in(disc)->work.segments);
}

TEST(PlanarLocalSum, errors) {
  const Region square = shapes::rectangle(-1, -1, 1, 1);
  PlanarLocalSum sum = near_sum(square, square);
  EXPECT_EQ(sum.in(PlanarBox{{0, 0}, {1, 0}}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.in(PlanarBox{{0, 0}, {1, HUGE_VAL}}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(sum.in(PlanarDisc{{0, 0}, 0}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.in(PlanarDisc{{NAN, 0}, 1}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(sum.in(PlanarBox{{0, 0}, {3, 3}})->edges.size(), 2U) << "and goes on";
  EXPECT_THROW(sum.in(PlanarBox{{0, 0}, {3, 3}})->exact(77), std::out_of_range);
  RegionData line;
  line.polylines.push_back({{0, 0}, {1, 0}});
  EXPECT_EQ(PlanarLocalSum::create(square, region_of(line)).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(PlanarLocalSum::create(square, shapes::rectangle(0, 0, 0x1p1001, 1)).error().code,
            ErrorCode::unsupported_operand);
  PlanarLocalOptions options;
  options.progress = [](std::string_view stage, double) { return stage != "arrangement"; };
  PlanarLocalSum stopped = PlanarLocalSum::create(square, square, options).value();
  EXPECT_EQ(stopped.in(PlanarBox{{0, 0}, {3, 3}}).error().code, ErrorCode::cancelled);
  EXPECT_EQ(near_sum(square, Region()).in(PlanarBox{{0, 0}, {3, 3}})->where, Where::outside);
}

}  // namespace
}  // namespace dymsum
