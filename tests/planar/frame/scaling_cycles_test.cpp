// Cycles that are carried from frame to frame, against cycles walked from scratch on the same lists; and what changed,
// counted by both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/frame_rings.h"
#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

using Edge = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, bool, int>;

/// Cycles from their smallest sub-edge on, with what is known of each.
std::multiset<std::tuple<std::vector<Edge>, std::uint32_t, int, bool>> cycles(const planar::FrameLoops& loops) {
  std::multiset<std::tuple<std::vector<Edge>, std::uint32_t, int, bool>> all;
  for (const planar::FrameLoop& loop : loops.loops()) {
    std::vector<Edge> edges;
    for (const planar::LoopStep& s : loop.steps)
      edges.emplace_back(s.edge, s.piece, s.from, s.to, s.node, s.vertex == planar::kNone, s.turn);
    std::rotate(edges.begin(), std::min_element(edges.begin(), edges.end()), edges.end());
    all.insert({std::move(edges), loop.corners, loop.turning, loop.kept});
  }
  return all;
}

TEST(ScalingCycles, those_carried_over_equal_those_walked_from_scratch) {
  const Region star = on_integers(shapes::noisy_star(60, 0.6, 3), 4000),
               other = on_integers(shapes::noisy_star(40, 0.6, 4), 3000);
  const Region room = on_integers(shapes::random_polygon(60, 3, 5), 3000),
               same = on_integers(shapes::random_polygon(60, 2, 8), 4000);
  std::uint64_t copied = 0, walked = 0, false_ones = 0, nodes = 0;
  const Region small = on_integers(shapes::noisy_star(16, 0.6, 4), 500);
  for (const auto& [p, q] : {std::pair{star, other}, std::pair{room, small}, std::pair{same, same}}) {
    auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 1}).value();
    planar::ScalingState state(base, {});
    const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(3, 2));
    planar::PieceLists lists(*window);
    planar::FrameLoops carried(lists);
    bool known = false;
    nodes += window->nodes.size();
    for (const int k : {1001, 1003, 1004, 1007, 1020, 1021, 1060, 1061, 1150, 1149, 1151, 1300, 1301, 1302, 1201}) {
      planar::ExactFrame position(base, planar::scale_value(exact::BigRational(k, 1000)));
      const double tau = position.tau(window->frame().moving);
      FrameWork work;
      if (!lists.repair(tau, position, work)) continue;
      known = carried.update(tau, position, !known, work);
      planar::FrameLoops fresh(lists);
      EXPECT_EQ(fresh.update(tau, position, true, work), known);
      if (!known) continue;
      EXPECT_EQ(cycles(carried), cycles(fresh)) << k;
      EXPECT_EQ(fresh.copied(), 0u);
      copied += carried.copied();
      for (const planar::FrameLoop& loop : carried.loops()) {
        walked += loop.fresh ? loop.steps.size() : 0;
        false_ones += !loop.kept;
      }
    }
  }
  // Intervals are copied, others walked; and both kinds of cycles are there.
  EXPECT_GT(copied, 500u);
  EXPECT_GT(walked, copied + 500);
  EXPECT_GT(false_ones, 10u);
  EXPECT_GT(nodes, 0u);
}

std::pair<Region, Region> touching_pair(oracles::Random& random) {
  const int kind = random.below(3);
  if (kind == 0) {
    const oracles::Pair pair = oracles::random_pair(random, 4 + random.below(6));
    return {Region::create(pair.p).value(), Region::create(pair.q).value()};
  }
  std::mt19937 engine(static_cast<std::uint32_t>(random.below(1 << 30)));
  if (kind == 1)
    return {skylines(engine, 3 + random.below(7), random.chance(50)),
            skylines(engine, 3 + random.below(5), random.chance(50))};
  const auto bars = [&](int count, int pitch) {
    std::vector<double> at;
    for (int i = 0; i < count; ++i) at.push_back(pitch * i + random.below(pitch - 1));
    return at;
  };
  return {comb(bars(2 + random.below(6), 5), 4 + random.below(40), random.chance(50)),
          comb(bars(2 + random.below(4), 3), 2 + random.below(20), random.chance(50))};
}

// DYMSUM_FUZZ_PAIRS / 10 pairs; many have segments that touch at every scale.
TEST(ScalingCycles, those_of_random_pairs_equal_those_walked_from_scratch) {
  const char* pairs = std::getenv("DYMSUM_FUZZ_PAIRS");
  const int rounds = pairs != nullptr ? std::atoi(pairs) / 10 : oracles::kSanitized ? 200 : 1000;
  std::uint64_t compared = 0, refused = 0, with_nodes = 0, at_nodes = 0, moved_on = 0;
  for (int round = 0; round < rounds; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const auto [p, q] = touching_pair(random);
    auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = static_cast<std::uint32_t>(random.below(2))})
                    .value();
    if (!base->regular || base->operands[0].size() == 0 || base->operands[1].size() == 0) continue;
    planar::ScalingState state(base, {});
    const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(2), random.chance(50));
    planar::PieceLists lists(*window);
    planar::FrameLoops carried(lists);
    with_nodes += !window->nodes.empty();
    bool known = false;
    for (int step = 0, k = 1001; step < 16; ++step) {
      k = random.chance(30) ? 1001 + random.below(998) : std::clamp(k + random.below(121) - 60, 1001, 1999);
      planar::ExactFrame position(base, planar::scale_value(exact::BigRational(k, 1000)));
      const double tau = position.tau(window->frame().moving);
      FrameWork work;
      if (!lists.repair(tau, position, work)) {
        known = false;
        continue;
      }
      const bool whole = !known;
      known = carried.update(tau, position, whole, work);
      planar::FrameLoops fresh(lists);
      ASSERT_EQ(fresh.update(tau, position, true, work), known) << "round " << round << ", " << k << "/1000";
      refused += !known;
      if (!known) continue;
      ASSERT_EQ(cycles(carried), cycles(fresh)) << "round " << round << ", " << k << "/1000";
      ++compared;
      for (const planar::FrameLoop& loop : carried.loops())
        for (const planar::LoopStep& s : loop.steps) {
          at_nodes += loop.kept && s.node != planar::kNone;
          moved_on += !whole && !loop.fresh && lists.has_changed(s.piece);
        }
    }
  }
  EXPECT_GT(compared, 5u * static_cast<unsigned>(rounds));
  std::printf("%llu frames compared, %llu for the vertex routine\n", static_cast<unsigned long long>(compared),
              static_cast<unsigned long long>(refused));
  EXPECT_GT(with_nodes, static_cast<unsigned>(rounds) / 4);
  EXPECT_GT(at_nodes, static_cast<unsigned>(rounds));
  EXPECT_GT(moved_on, static_cast<unsigned>(rounds) / 4);
}

TEST(ScalingCycles, what_changed_on_a_ring_is_counted_as_by_comparing_both_sums) {
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.3;
  const Region p = on_integers(shapes::noisy_star(60, 0.6, 3), 4000),
               q = on_integers(shapes::noisy_star(40, 0.6, 4), 3000);
  ScalingSum sum = ScalingSum::create(p, q, options).value();
  int compared = 0, reshaped = 0;
  for (int k = 101; k < 160; ++k) {
    const PlanarSum before = sum.sum();
    const std::vector<std::uint64_t> ids = sum.ring_ids();
    const FrameChanges changes = sum.set(scale_of(k, 100)).value();
    if (sum.work().new_window || sum.work().degenerate || ids.size() != 1 || sum.ring_ids() != ids) continue;
    planar::RingIdentities identities;
    FrameChanges expected;
    identities.match(before, ids, sum.sum(), false, expected);
    EXPECT_EQ(changes.rings, expected.rings) << k;
    ++compared;
    reshaped += changes.rings[0].kind == RingChange::Kind::reshaped;
  }
  EXPECT_GT(compared, 20);
  EXPECT_GT(reshaped, 10);
}

}  // namespace
}  // namespace dymsum
