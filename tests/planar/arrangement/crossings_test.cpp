// The ways of finding where segments meet: all of them find the same, and a mask leaves out only what lies inside the
// sum.
#include "planar/arrangement/crossings.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <tuple>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/operand.h"
#include "planar/sum/reduced.h"

namespace dymsum::planar {
namespace {

constexpr std::uint64_t kSeed = 161803;

/// The reduced convolution of a pair as segments without chains.
struct Segments {
  Segments(const Region& a, const Region& b) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    p = placed_on(*lattice, kept_p);
    q = placed_on(*lattice, kept_q);
    soup.emplace(*lattice, *p, *q);
    add_all(ReducedConvolution(*lattice, *p, *q), *soup);
  }
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
  std::optional<Soup> soup;
};

using Crossed = std::tuple<std::uint32_t, std::uint32_t, double, double>;
using Touched = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

struct Found {
  std::set<Crossed> crossings;
  std::set<Touched> touches;
  std::size_t crossings_told = 0;
  friend bool operator==(const Found&, const Found&) = default;
};

template <class Find>
Found found(const Segments& segments, const Find& find) {
  Meetings meetings;
  CrossingFinder finder(*segments.soup, meetings);
  find(finder);
  Found f;
  for (const Crossing& c : meetings.crossings) {
    EXPECT_GT(segments.soup->cross(c.a, c.b), 0);
    f.crossings.emplace(c.a, c.b, c.ta, c.tb);
  }
  for (const Touch& t : meetings.touches) f.touches.emplace(t.segment, t.pair.p, t.pair.q);
  f.crossings_told = meetings.crossings.size();
  return f;
}

Found of_all_pairs(const Segments& s) {
  return found(s, [](CrossingFinder& f) { f.all_pairs(); });
}
Found of_sweep(const Segments& s) {
  return found(s, [](CrossingFinder& f) { f.sweep(); });
}
Found of_grid(const Segments& s, int cells) {
  const SumGrid sum_grid({s.p->points->width, s.q->points->width}, {s.p->points->height, s.q->points->height}, cells);
  Array<CoveredMark> marks;
  const Found f = found(s, [&](CrossingFinder& finder) { finder.grid(sum_grid.whole, nullptr, marks); });
  EXPECT_TRUE(marks.empty());
  return f;
}

/// The parameters depend on which segment of a pair comes first, in their last bits.
std::set<std::tuple<std::uint32_t, std::uint32_t>> pairs_of(const Found& f) {
  std::set<std::tuple<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [a, b, ta, tb] : f.crossings) pairs.emplace(a, b);
  EXPECT_EQ(pairs.size(), f.crossings_told) << "a pair told twice";
  return pairs;
}

TEST(Crossings, sweep_and_grid_find_on_tiny_grids_what_all_pairs_find) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::size_t crossings = 0, touches = 0;
  for (std::uint64_t k = 0; k < 1200; ++k) {
    oracles::Random random(kSeed + k);
    const auto [p, q] = oracles::random_pair(random, 2 + random.below(7));
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + oracles::to_text(p, q));
    const Segments segments(Region::create(p).value(), Region::create(q).value());
    if (segments.soup->size() == 0) continue;
    const Found all = of_all_pairs(segments);
    crossings += all.crossings.size();
    touches += all.touches.size();
    for (const Found& other : {of_sweep(segments), of_grid(segments, 2 + random.below(12))}) {
      ASSERT_EQ(pairs_of(other), pairs_of(all));
      ASSERT_EQ(other.touches, all.touches);
    }
  }
  EXPECT_GT(crossings, 2000u);
  EXPECT_GT(touches, 2000u);
}

// Of all sizes on both sides of the one from which on boxes are sorted, and not multiples of eight.
TEST(Crossings, sweep_and_grid_find_in_larger_sums_what_all_pairs_find) {
  std::set<bool> large;
  for (int n = 3; n < 60; n = n * 5 / 4 + 1) {
    const Segments segments(shapes::noisy_star(n, 0.8, kSeed), shapes::noisy_star(n + 3, 0.7, kSeed + 1));
    large.insert(segments.soup->size() > 64);
    const Found all = of_all_pairs(segments);
    EXPECT_EQ(pairs_of(of_sweep(segments)), pairs_of(all)) << n;
    EXPECT_EQ(pairs_of(of_grid(segments, 8 + n)), pairs_of(all)) << n;
  }
  EXPECT_EQ(large.size(), 2u);
}

// Where contacts coincide, the first one found is named: few boxes, which are not sorted, must tell them in the same
// order as many.
TEST(Crossings, few_and_many_boxes_tell_what_they_find_from_left_to_right) {
  std::set<bool> large;
  for (const int n : {12, 14, 16, 20, 30, 60}) {
    const Segments segments(shapes::noisy_star(n, 0.8, kSeed), shapes::noisy_star(n + 3, 0.7, kSeed + 1));
    const Soup& soup = *segments.soup;
    Meetings meetings;
    CrossingFinder finder(soup, meetings);
    finder.sweep();
    ASSERT_GT(meetings.crossings.size(), 2u) << n;
    large.insert(soup.size() > 64);
    const double quantum = soup.lattice.span / 0x7ff0;
    const auto left = [&](std::uint32_t s) { return std::min(soup.boxes[s].ax, soup.boxes[s].bx); };
    double last = 0;
    for (const Crossing& c : meetings.crossings) {
      const double earlier = std::min(left(c.a), left(c.b));
      EXPECT_GE(earlier, last - quantum) << n;
      last = earlier;
    }
  }
  EXPECT_EQ(large.size(), 2u);
}

TEST(Crossings, boxes_of_spans_without_quanta_all_meet) {
  const auto scaled = [](double f, Ring ring) {
    for (Point& v : ring) v = {f * v.x, f * v.y};
    return Region::create({{{std::move(ring), {}}}, {}, {}}).value();
  };
  const Ring p{{0, 0}, {7, 1}, {3, 3}, {9, 8}, {1, 5}}, q{{0, 0}, {5, 2}, {2, 3}, {6, 7}, {-1, 4}};
  const Segments ordinary(scaled(1, p), scaled(1, q));
  const std::size_t expected = of_all_pairs(ordinary).crossings.size();
  ASSERT_GT(expected, 0u);
  for (const double f : {0x1p-1070, 0x1p-1022, 0x1p990}) {
    const Segments segments(scaled(f, p), scaled(f, q));
    EXPECT_EQ(pairs_of(of_sweep(segments)).size(), expected) << f;
    EXPECT_EQ(pairs_of(of_all_pairs(segments)).size(), expected) << f;
  }
}

TEST(Crossings, a_mask_leaves_out_only_crossings_inside_the_sum) {
  const Region p = shapes::noisy_star(120, 0.8, kSeed), q = shapes::noisy_star(100, 0.8, kSeed + 1);
  const Segments segments(p, q);
  const InteriorMask mask(*segments.p, *segments.q, 120);
  const Found all = of_all_pairs(segments), live = found(segments, [&](CrossingFinder&f) { f.sweep(&mask); });
  EXPECT_LT(live.crossings.size(), all.crossings.size() / 2);
  ASSERT_FALSE(live.crossings.empty());
  const auto decided = pairs_of(live);
  const auto known = pairs_of(all);
  for (const auto& pair : decided) EXPECT_TRUE(known.contains(pair));
  std::size_t queried = 0;
  for (const auto& [a, b, ta, tb] : all.crossings) {
    if (decided.contains({a, b}) || ++queried % 50 != 0) continue;
    const SoupBox& box = segments.soup->boxes[a];
    const Point at = segments.lattice->to_input(box.ax + ta * (box.bx - box.ax), box.ay + ta * (box.by - box.ay));
    EXPECT_TRUE(contains(p, q, at, Semantics::open)) << at.x << " " << at.y;
  }
  EXPECT_GT(queried, 1000u);
}

// Against the crossing computed with more than twice the digits: doubles of this size are exact integers.
TEST(Crossings, parameters_err_by_at_most_their_bound) {
  std::size_t compared = 0;
  double worst = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Segments s(shapes::noisy_star(14, 0.9, kSeed + k), shapes::noisy_star(12, 0.9, kSeed + k + 100));
    for (const auto& [a, b, ta, tb] : of_sweep(s).crossings) {
      // t = (side of a's start) / (that - side of a's end) with respect to b, from exact positions.
      const auto at = [&](WalkPair v) { return s.lattice->position(s.soup->exact(v)); };
      const auto a0 = at(s.soup->start(a)), a1 = at(s.soup->end(a)), b0 = at(s.soup->start(b)), b1 = at(s.soup->end(b));
      const auto side = [&](const Lattice::Position& z) {
        return exact::BigRational((b1.x - b0.x) * (z.y - b0.y) - (b1.y - b0.y) * (z.x - b0.x));
      };
      const exact::BigRational from = side(a0), to = side(a1), t = from / (from - to);
      const double error = std::abs(exact::round_to_double(exact::BigRational(t - exact::exact_value(ta))));
      ASSERT_LE(error, s.soup->parameter_error(a, b));
      worst = std::max(worst, error / s.soup->parameter_error(a, b));
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000u);
  EXPECT_GT(worst, 1e-6) << "a bound that says nothing";
}

// Few segments, enough for a mask, and so many live ones that a grid is filled: which path answered, and that all
// engines agree.
Region quarter_turned(const Region& region) {
  Ring ring;
  for (const Point& v : region.data().parts.at(0).outer) ring.push_back({-v.y, v.x});
  return Region::create({{{std::move(ring), {}}}, {}, {}}).value();
}

TEST(Crossings, sums_are_the_same_however_their_crossings_are_found) {
  struct Case {
    Region p, q;
    bool mask, grid;
  };
  const Case cases[] = {
      {shapes::noisy_star(20, 0.8, 1), shapes::noisy_star(20, 0.8, 2), false, false},
      {shapes::noisy_star(60, 0.9, 3), shapes::noisy_star(60, 0.9, 4), true, false},
      {shapes::noisy_star(100, 0.3, 5), shapes::random_polygon(40, 3, 6), true, false},
      {shapes::grate(120, 1, 0.25, 20), snapped_shapes::disc(16, 0.125), true, false},  // with holes
      {shapes::comb(900, 2, 1, 40), snapped_shapes::disc(8, 0.75), true, false},        // swept, although many
      {quarter_turned(shapes::comb(400, 2, 1, 800)), snapped_shapes::disc(16, 0.75), true, true}};
  std::size_t holes = 0;
  for (const Case& c : cases) {
    const PlanarSum sum = minkowski_sum(c.p, c.q).value();
    SCOPED_TRACE(sum.stats.reduced_segments);
    EXPECT_EQ(sum.stats.mask_grid > 0, c.mask);
    EXPECT_EQ(sum.stats.cell_entries > 0, c.grid);
    holes += sum.hole_count();
    SumOptions options;
    options.engine = sum.stats.live_segments > 4000 ? Engine::winding : Engine::brute;
    EXPECT_TRUE(sum == minkowski_sum(c.p, c.q, options).value());
  }
  EXPECT_GE(holes, 119u);
}

}  // namespace
}  // namespace dymsum::planar
