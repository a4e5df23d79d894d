// Collision tests in doubles against exact ones, and the pairs of boxes that windows are made of against all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/rotating_loops.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {
namespace {

struct Tally {
  std::uint64_t free = 0, overlap = 0, unknown = 0;
};

// Beside every sub-edge of every cycle of one frame, and every segment.
void compare(const Region& p, const Region& q, double radians, Tally& tally) {
  const auto base = pair_of_regions(p, q, PairOptions{.moved = 1}).value();
  if (!base->regular || !base->connected) return;
  const TurningForms forms(*base);
  const RotationCatalog catalog(forms);
  const RotationGrid grid(forms, 16);
  const Orientation theta = Orientation::nearest(radians, 1e-7).value();
  const RotatingWindow window(grid, catalog, theta.radians() + 0.003, 0.01, false);
  RotatingFrame frame(window);
  if (!frame.compute(theta.radians() - window.midpoint, Heading::of(theta.radians()))) return;
  RotatingOverlap overlap(forms);
  ExactFrame position(base, theta);
  const auto source = [&](std::uint32_t s) {
    const WalkSegment& w = window.segments[s];
    return Segment{forms.operand(w.side).edge(w.edge), forms.operand(1 - w.side).source[w.vertex]};
  };
  const auto by = [&](std::uint32_t s) {
    return s == RotatingFrame::kEnd ? std::nullopt : std::optional<Segment>(source(s));
  };
  const auto check = [&](const RotatingFrame::Step& s) {
    const RotatingOverlap::Result decided = overlap.right_of(frame, s);
    const bool inside = position.inside_right_of(source(s.segment), by(s.from), by(s.to));
    tally.free += decided.answer == RotatingOverlap::Answer::free;
    tally.overlap += decided.answer == RotatingOverlap::Answer::overlap;
    tally.unknown += decided.answer == RotatingOverlap::Answer::unknown;
    if (decided.answer != RotatingOverlap::Answer::unknown) {
      ASSERT_EQ(inside, decided.answer == RotatingOverlap::Answer::overlap);
    }
  };
  for (const RotatingFrame::Step& s : frame.steps()) ASSERT_NO_FATAL_FAILURE(check(s));
  // And in the middle of every segment that exists, whatever crosses it.
  for (std::uint32_t i = 0; i < window.segments.size(); ++i)
    if (catalog.exists(window.segments[i], theta.radians()) == RotationCatalog::Existence::yes) {
      RotatingFrame::Step s;
      s.segment = i;
      ASSERT_NO_FATAL_FAILURE(check(s));
    }
}

TEST(RotatingOverlap, agrees_with_exact_collision_tests_beside_every_sub_edge) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracles::Random random(seed);
    const oracles::Pair pair = oracles::random_pair(random, 3 + static_cast<int>(random.below(8)));
    const Region p = Region::create(pair.p).value(), q = Region::create(pair.q).value();
    ASSERT_NO_FATAL_FAILURE(
        compare(p, q, random.chance(30) ? 1e-9 : 0.01 * static_cast<double>(random.below(600)), tally));
  }
  for (int seed = 1; seed <= 30; ++seed)
    ASSERT_NO_FATAL_FAILURE(
        compare(shapes::random_polygon(50, 3, seed), shapes::noisy_star(20, 0.6, seed + 1), 0.2 * seed, tally));
  ASSERT_NO_FATAL_FAILURE(compare(shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(50, 0.7, 2), 0.8, tally));
  ASSERT_NO_FATAL_FAILURE(compare(shapes::grate(6, 4, 1, 20), shapes::comb(7, 2, 1, 5), 1.1, tally));
  // It decides nearly always: a test that it left to the exact one would cost ten times as much.
  EXPECT_GT(tally.free, 1000u);
  EXPECT_GT(tally.overlap, 50u);
  EXPECT_LT(tally.unknown, 20u);
}

TEST(BoxPairs, are_those_of_all_pairs) {
  for (const int n : {0, 1, 2, 7, 30, 200, 1000}) {
    oracles::Random random(static_cast<std::uint64_t>(n) + 7);
    struct Box {
      double x0, y0, x1, y1;
    };
    std::vector<Box> boxes;
    BoxPairs pairs(100);
    for (int i = 0; i < n; ++i) {
      const auto index = [&](std::uint64_t below) { return static_cast<double>(random.below(below)); };
      // Low boxes are swept in strips.
      const double x = index(100), y = index(100), w = index(12), h = index(n < 1000 ? 30 : 4);
      boxes.push_back({x, y, x + w, y + h});  // some beyond the rim
      pairs.add(x, y, x + w, y + h);
    }
    std::set<std::array<std::uint32_t, 2>> found;
    for (const auto& pair : pairs.find()) {
      EXPECT_LT(pair[0], pair[1]);
      EXPECT_TRUE(found.insert(pair).second) << "twice";
    }
    std::size_t meet = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
        const Box &a = boxes[i], &b = boxes[j];
        if (a.x0 > b.x1 || b.x0 > a.x1 || a.y0 > b.y1 || b.y0 > a.y1) continue;
        ++meet;
        EXPECT_EQ(found.count({i, j}), 1u);
      }
    EXPECT_LE(found.size(), meet + meet / 4 + 8) << "only those that nearly meet besides";
  }
}

}  // namespace
}  // namespace dymsum::planar
