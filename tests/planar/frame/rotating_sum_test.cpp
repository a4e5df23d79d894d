// The rotating sum against slices, which share none of its windows, crossings or loops with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/rotating_frames.h"

namespace dymsum {
namespace {

using rotating_frames::at, rotating_frames::expect_frame, rotating_frames::fresh;

std::uint64_t fuzz_rounds(std::uint64_t usual) {
  const char* pairs = std::getenv("DYMSUM_FUZZ_PAIRS");
  return pairs != nullptr ? std::max<std::uint64_t>(usual, std::strtoull(pairs, nullptr, 10) / 40) : usual;
}

TEST(RotatingSum, tiny_pairs_equal_slices_at_every_step) {
  std::uint64_t updated = 0, degenerate = 0, decided = 0, tested = 0, holes = 0, parts = 0;
  const char* one = std::getenv("DYMSUM_SEED");
  const std::uint64_t first = one != nullptr ? std::strtoull(one, nullptr, 10) : 1,
                      rounds = one != nullptr ? 1 : fuzz_rounds(250);
  for (std::uint64_t seed = first; seed < first + rounds; ++seed) {
    SCOPED_TRACE("DYMSUM_SEED=" + std::to_string(seed));
    oracles::Random random(seed);
    const oracles::Pair pair = oracles::random_pair(random, 3 + static_cast<int>(random.below(8)));
    const Region p = Region::create(pair.p).value(), q = Region::create(pair.q).value();
    MovingOptions options;
    options.reflect_q = random.chance(30);
    options.moving = options.reflect_q || random.chance(50) ? MovingOperand::q : MovingOperand::p;
    options.semantics = random.chance(20)   ? Semantics::open
                        : random.chance(20) ? Semantics::regular
                                            : Semantics::closed;
    options.mode = random.chance(70) ? FrameMode::window : FrameMode::automatic;
    options.window = random.chance(70) ? 0.02 * static_cast<double>(1 + random.below(20)) : 0;
    planar::SumInternals::min_tier_bits(options) = random.chance(20) ? 61 : 0;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    double theta = random.chance(50) ? 0 : 0.5 * std::numbers::pi * static_cast<double>(random.below(4));
    for (int step = 0; step < 12; ++step) {
      // Coarse errors give simple orientations, at which more coincides.
      const Orientation orientation = at(theta, random.chance(30) ? 0.02 : 1e-5);
      ASSERT_TRUE(sum.set(orientation).ok());
      // With Q turning and not reflected the slice names contacts the other way round.
      const bool contacts = options.reflect_q || options.moving == MovingOperand::p;
      ASSERT_NO_FATAL_FAILURE(expect_frame(sum, fresh(p, q, orientation, options), contacts))
          << "theta = " << orientation.radians();
      updated += !sum.work().rebuilt;
      degenerate += sum.work().degenerate;
      decided += sum.work().loops_kept;
      tested += sum.work().collision_tests;
      holes += sum.sum().hole_count();
      parts += sum.sum().parts.size() > 1;
      theta += random.chance(10) ? 1.0 : 0.01 * (static_cast<double>(random.below(9)) - 4);
    }
  }
  if (rounds == 1) return;
  EXPECT_GT(updated, 500u);
  EXPECT_GT(degenerate, 50u);
  EXPECT_GT(decided, 100u);
  EXPECT_GT(tested, 10u);
  EXPECT_GT(holes, 20u);
  EXPECT_GT(parts, 20u);
}

struct TurnedPair {
  const char* name;
  Region p, q;
};

std::vector<TurnedPair> turned_pairs() {
  std::vector<TurnedPair> list;
  list.push_back({"star 60 and star 50", shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(50, 0.7, 2)});
  list.push_back({"random with holes and star", shapes::random_polygon(120, 5, 3), shapes::noisy_star(24, 0.6, 4)});
  list.push_back({"pockets and disc", snapped_shapes::pockets(12, 10), snapped_shapes::disc(16, 1)});
  list.push_back({"spiral and gear", snapped_shapes::spiral(3, 24, 1, 0.4), snapped_shapes::gear(9, 1, 1.3)});
  list.push_back({"grate and comb", shapes::grate(6, 4, 1, 20), shapes::comb(7, 2, 1, 5)});
  return list;
}

TEST(RotatingSum, larger_pairs_with_masks_equal_slices) {
  for (const TurnedPair& shape : turned_pairs())
    for (const bool q_turns : {false, true})
      for (const double width : {0.0, 0.04, 0.2}) {
        SCOPED_TRACE(shape.name);
        MovingOptions options;
        options.moving = q_turns ? MovingOperand::q : MovingOperand::p;
        options.mode = FrameMode::window;
        options.window = width;
        RotatingSum sum = RotatingSum::create(shape.p, shape.q, options).value();
        std::uint64_t updated = 0;
        double theta = 0.7;
        oracles::Random random(5);
        for (int step = 0; step < 40; ++step) {
          theta += random.chance(80) ? 0.0126 : -0.03;
          const Orientation orientation = at(theta);
          ASSERT_TRUE(sum.set(orientation).ok());
          updated += !sum.work().new_window && !sum.work().rebuilt;
          ASSERT_NO_FATAL_FAILURE(expect_frame(sum, fresh(shape.p, shape.q, orientation, options), !q_turns))
              << "step " << step << ", width " << width;
        }
        EXPECT_GT(updated, 10u);
      }
}

// Steps of every kind: windows are entered from either side, left at once, and built anew in the middle of nowhere.
TEST(RotatingSum, random_walks_equal_slices) {
  const TurnedPair shapes[]{
      {"star and star", shapes::noisy_star(26, 0.5, 1), shapes::noisy_star(20, 0.7, 2)},
      {"random with holes and gear", shapes::random_polygon(50, 3, 7), snapped_shapes::gear(7, 1, 1.3)}};
  for (const TurnedPair& shape : shapes)
    for (const FrameMode mode : {FrameMode::window, FrameMode::automatic}) {
      SCOPED_TRACE(shape.name);
      MovingOptions options;
      options.mode = mode;
      RotatingSum sum = RotatingSum::create(shape.p, shape.q, options).value();
      oracles::Random random(9);
      std::uint64_t updated = 0;
      double theta = 0.2;
      for (int k = 0; k < 120; ++k) {
        const double fraction = static_cast<double>(1 + random.below(1000)) / 1000, sign = random.chance(50) ? 1 : -1;
        switch (k / 5 % 6) {
          case 0:
            theta += sign * fraction * 1e-7;
            break;
          case 1:
            theta += 0.0126;
            break;
          case 2:
            theta -= 0.0126 * fraction;
            break;
          case 3:
            theta += k % 2 == 0 ? 0.02 : -0.02;
            break;
          case 4:
            theta += sign * 3 * fraction;
            break;
          default:
            theta = 0.5 * std::numbers::pi * static_cast<double>(random.below(4)) + sign * fraction * 0.004;
            break;
        }
        const Orientation orientation = at(theta, 1e-9);
        ASSERT_TRUE(sum.set(orientation).ok());
        updated += !sum.work().rebuilt && !sum.work().new_window;
        ASSERT_NO_FATAL_FAILURE(expect_frame(sum, fresh(shape.p, shape.q, orientation, options), true)) << "step " << k;
      }
      EXPECT_GT(updated, 10u);
    }
}

// Raw outlines have many: doubles know the position badly, and every sign well.
TEST(RotatingSum, crossings_of_nearly_parallel_edges_are_no_reason_to_compute_from_scratch) {
  // The lower step rises over the position of the upper one's end.
  const double low = 5 - 0x1p-10;
  const Region p = Region::create(RegionData{{{{{0, 0}, {20, 0}, {20, 5}, {10, 5}, {10, low}, {0, low}}, {}}}, {}, {}})
                       .value(),
               q = shapes::rectangle(0, 0, 8, 8);
  MovingOptions options;
  options.mode = FrameMode::window;
  RotatingSum sum = RotatingSum::create(p, q, options).value();
  for (int k = 0; k < 20; ++k) {
    const Orientation orientation = at(-0.0005 - 0.0001 * k, 1e-9);
    ASSERT_TRUE(sum.set(orientation).ok());
    EXPECT_FALSE(sum.work().rebuilt) << k;
    const PlanarSum wanted = fresh(p, q, orientation, options);
    ASSERT_NO_FATAL_FAILURE(expect_frame(sum, wanted, true)) << k;
    EXPECT_LT(sum.sum().at_error, 1e-9) << "positions are rounded from exact ones";
    EXPECT_TRUE(std::ranges::any_of(sum.sum().parts[0].outer.vertices, [](const SumVertex& v) {
      return v.corner_p == SumVertex::kNone;
    })) << "a crossing";
  }
}

TEST(RotatingSum, every_slice_around_an_event_is_right_from_both_sides) {
  // A square in a slot: free at quarter turns only.
  const Region slot = shapes::grate(4, 2, 1, 3), square = shapes::rectangle(0, 0, 1, 1);
  for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
    MovingOptions options;
    options.moving = MovingOperand::q;
    options.reflect_q = true;
    options.semantics = semantics;
    options.mode = FrameMode::window;
    RotatingSum sum = RotatingSum::create(slot, square, options).value();
    for (const double quarter : {0.0, 0.5 * std::numbers::pi, std::numbers::pi, -0.5 * std::numbers::pi})
      for (int k = 30; k > 0; k -= 3)
        for (const double theta : {quarter - std::ldexp(1.0, -k), quarter, quarter + std::ldexp(1.0, -k)}) {
          const Orientation orientation = Orientation::nearest(theta).value();
          ASSERT_TRUE(sum.set(orientation).ok());
          ASSERT_NO_FATAL_FAILURE(expect_frame(sum, fresh(slot, square, orientation, options), true)) << theta;
          if (semantics == Semantics::open && theta == quarter) {
            EXPECT_GT(sum.sum().tight_points.size() + sum.sum().tight_segments.size(), 0u) << theta;
          }
        }
  }
}

TEST(RotatingSum, a_full_turn_and_the_way_back_return_the_same_state) {
  const Region p = shapes::random_polygon(60, 3, 5), q = shapes::noisy_star(16, 0.6, 4);
  RotatingSum sum = RotatingSum::create(p, q).value();
  const PlanarSum start = sum.sum();
  constexpr int kSteps = 300;
  std::vector<PlanarSum> seen;
  for (int k = 1; k <= kSteps; ++k) {
    ASSERT_TRUE(sum.set(at(2 * std::numbers::pi * k / kSteps)).ok());
    seen.push_back(sum.sum());
  }
  ASSERT_TRUE(sum.set(Orientation()).ok());
  EXPECT_TRUE(sum.sum() == start);
  for (int k = kSteps; k > 0; --k) {
    ASSERT_TRUE(sum.set(at(2 * std::numbers::pi * k / kSteps)).ok());
    ASSERT_TRUE(sum.sum() == seen[static_cast<std::size_t>(k - 1)]) << k;
  }
}

TEST(RotatingSum, identities_and_changes_account_for_every_ring) {
  const Region p = shapes::random_polygon(60, 3, 5), q = shapes::noisy_star(12, 0.6, 4);
  RotatingSum sum = RotatingSum::create(p, q).value();
  std::vector<std::uint64_t> alive = sum.ring_ids(), ended;
  PlanarSum before = sum.sum();
  for (int k = 1; k < 300; ++k) {
    const FrameChanges changes = sum.set(at(0.01 * k)).value();
    std::vector<std::uint64_t> next = alive;
    std::int64_t more = 0;
    for (const RingChange& c : changes.rings) {
      more += std::int64_t{c.vertices_appeared} - std::int64_t{c.vertices_disappeared};
      if (c.kind == RingChange::Kind::appeared) {
        EXPECT_EQ(std::count(ended.begin(), ended.end(), c.ring), 0) << "an identity used again";
        next.push_back(c.ring);
        continue;
      }
      const auto it = std::find(next.begin(), next.end(), c.ring);
      ASSERT_NE(it, next.end());
      if (c.kind != RingChange::Kind::disappeared) continue;
      ended.push_back(c.ring);
      next.erase(it);
    }
    EXPECT_EQ(more,
              static_cast<std::int64_t>(sum.sum().vertex_count()) - static_cast<std::int64_t>(before.vertex_count()))
        << k;
    EXPECT_EQ(changes.topology,
              before.hole_count() != sum.sum().hole_count() || before.parts.size() != sum.sum().parts.size())
        << k;
    alive = sum.ring_ids();
    std::vector<std::uint64_t> now = alive;
    std::sort(now.begin(), now.end());
    std::sort(next.begin(), next.end());
    EXPECT_EQ(now, next) << k;
    before = sum.sum();
  }
  EXPECT_TRUE(sum.set(sum.orientation()).value().rings.empty());
}

TEST(RotatingSum, a_frame_inside_a_window_looks_only_there) {
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.1;
  RotatingSum sum =
      RotatingSum::create(shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(50, 0.7, 2), options).value();
  ASSERT_TRUE(sum.set(at(0.3)).ok());
  EXPECT_TRUE(sum.work().new_window);
  const std::uint64_t segments = sum.sum().stats.reduced_segments;
  ASSERT_TRUE(sum.set(at(0.3001)).ok());
  EXPECT_FALSE(sum.work().new_window);
  EXPECT_FALSE(sum.work().rebuilt);
  EXPECT_LT(sum.sum().stats.live_segments, segments);
  EXPECT_EQ(sum.work().loops_kept, sum.work().loops_traced) << "every loop is told by the frame before";
  EXPECT_EQ(sum.work().collision_tests, 0u);
  EXPECT_EQ(sum.work().exact_signs, 0u);
}

TEST(RotatingSum, polylines_points_and_nothing_are_computed_from_scratch) {
  RegionData line;
  line.polylines.push_back({{0, 0}, {3, 1}, {4, 4}});
  line.points.push_back({-2, 0});
  const Region thin = Region::create(line).value(), disc = snapped_shapes::disc(8, 1);
  RotatingSum sum = RotatingSum::create(thin, disc).value();
  for (int k = 1; k < 10; ++k) {
    const Orientation theta = at(0.05 * k);
    ASSERT_TRUE(sum.set(theta).ok());
    EXPECT_TRUE(sum.work().rebuilt);
    EXPECT_TRUE(sum.sum() == rotated_sum(thin, disc, theta).value());
  }
  RotatingSum none = RotatingSum::create(Region(), disc).value();
  ASSERT_TRUE(none.set(at(1)).ok());
  EXPECT_TRUE(none.sum().parts.empty());
}

// At the rational event angles of the obstacle something touches: such a frame may not be taken from doubles.
TEST(RotatingSum, frames_at_exact_events_equal_slices) {
  std::uint64_t triples = 0, changes = 0, undecided = 0;
  for (std::uint64_t seed = 1; seed <= fuzz_rounds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracles::Random random(seed + 900);
    const auto polygon = [&](int grid) {
      for (;;) {
        RegionData data;
        data.parts.push_back({oracles::random_polygon(random, grid, 7), {}});
        const Result<Region> region = Region::create(data);
        if (region.ok() && region->touching_points().empty()) return *region;
      }
    };
    const Region p = polygon(7), q = polygon(5);
    const CspaceObstacle obstacle = CspaceObstacle::create(q, p).value();
    MovingOptions options;
    options.moving = MovingOperand::q;
    options.reflect_q = true;
    options.mode = FrameMode::window;
    options.window = 0.05;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    // The obstacle also lists angles at which it looked and found nothing changed.
    std::set<std::uint32_t> changing;
    for (const Patch& patch : obstacle.patches()) changing.insert({patch.begin, patch.end});
    for (const ObstacleEvent& e : obstacle.events()) {
      const std::optional<Orientation>& exact = obstacle.angles()[e.angle].exact;
      if (!exact) continue;
      ASSERT_TRUE(sum.set(at(exact->radians() - 0.01)).ok());
      ASSERT_TRUE(sum.set(*exact).ok());
      ASSERT_TRUE(sum.sum() == cspace_slice(q, p, *exact).value()) << exact->radians();
      triples += e.kind == ObstacleEvent::Kind::three_segments;
      if (!changing.contains(e.angle)) continue;
      ++changes;
      undecided += sum.work().rebuilt;
    }
  }
  EXPECT_GT(changes, 100u);
  EXPECT_GT(triples, 0u);
  EXPECT_EQ(undecided, changes);
}

// Between two frames loops come and go: what looks like the same sub-edge may have been another one.
TEST(RotatingSum, large_steps_in_wide_windows_equal_slices) {
  for (std::uint64_t seed = 1; seed <= fuzz_rounds(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracles::Random random(seed + 5000);
    const Region p =
        shapes::random_polygon(12 + static_cast<int>(random.below(10)), static_cast<int>(random.below(3)), seed);
    const Region q = shapes::noisy_star(6 + static_cast<int>(random.below(8)), 0.8, seed + 1);
    MovingOptions options;
    options.mode = FrameMode::window;
    options.window = 1.2;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    double theta = 0.3;
    for (int step = 0; step < 14; ++step) {
      theta += random.chance(50) ? 0.2 : random.chance(50) ? 0.05 : -0.15;
      ASSERT_TRUE(sum.set(at(theta)).ok());
      ASSERT_TRUE(sum.sum() == rotated_sum(p, q, at(theta)).value()) << "step " << step;
    }
  }
}

// Of a ring that only begins at another vertex none has come or gone.
TEST(RotatingSum, a_ring_that_begins_elsewhere_has_moved) {
  const auto triangle = [](const Ring& ring) { return Region::create({{{ring, {}}}, {}, {}}).value(); };
  const Region p = triangle({{0, 0}, {3, 1}, {0, 2}}), q = triangle({{0, 0}, {2, 1}, {1, 3}});
  for (const FrameMode mode : {FrameMode::rebuild, FrameMode::automatic, FrameMode::window}) {
    MovingOptions options;
    options.mode = mode;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    ASSERT_TRUE(sum.set(Orientation::of(-1, 1000).value()).ok());
    const SumVertex first = sum.sum().parts[0].outer.vertices[0];
    const FrameChanges changes = sum.set(Orientation::of(1, 1000).value()).value();
    const SumVertex now = sum.sum().parts[0].outer.vertices[0];
    EXPECT_FALSE(first.in == now.in && first.out == now.out) << "it begins elsewhere";
    ASSERT_EQ(changes.rings.size(), 1u);
    EXPECT_EQ(changes.rings[0].kind, RingChange::Kind::moved);
  }
}

// A hole that is covered at one angle and free at the next, its edges and crossings being the same: what covers it has
// passed over it.
TEST(RotatingSum, a_hole_uncovered_in_one_step_appears) {
  const auto square = [](double x, double y, double half) {
    return Ring{{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
  };
  RegionData fixed, turning;
  fixed.parts.push_back({square(0, 0, 4), {{{-1.5, -1.5}, {-1.5, 1.5}, {1.5, 1.5}, {1.5, -1.5}}}});
  fixed.parts.push_back({square(-9.8, -2, 2), {}});
  turning.parts.push_back({square(0, 0, 0.5), {}});
  turning.parts.push_back({square(10, 0, 0.5), {}});
  const Region p = Region::create(fixed).value(), q = Region::create(turning).value();
  // The frame before lies in the window, or does not.
  for (const double window : {1.5, 0.05}) {
    MovingOptions options;
    options.moving = MovingOperand::q;
    options.mode = FrameMode::window;
    options.window = window;
    RotatingSum sum = RotatingSum::create(p, q, options).value();
    for (const double theta : {0.15, 0.2, 0.8, 0.85, 0.2, 0.8}) {
      ASSERT_TRUE(sum.set(at(theta)).ok());
      EXPECT_FALSE(sum.work().rebuilt);
      ASSERT_TRUE(sum.sum() == fresh(p, q, at(theta), options)) << theta;
      EXPECT_EQ(sum.sum().hole_count(), theta < 0.5 ? 1u : 2u) << theta;  // another one lies between the parts
    }
  }
}

// Costs are counted, so what else the machine does changes nothing.
TEST(RotatingSum, the_same_motion_is_followed_in_the_same_way) {
  const Region p = shapes::noisy_star(60, 0.5, 1), q = shapes::noisy_star(50, 0.7, 2);
  std::vector<std::array<std::uint64_t, 4>> seen;
  std::uint64_t windows = 0;
  for (const bool again : {false, true}) {
    RotatingSum sum = RotatingSum::create(p, q).value();
    for (std::size_t k = 1; k < 100; ++k) {
      ASSERT_TRUE(sum.set(at(0.0126 * static_cast<double>(k))).ok());
      const FrameWork& work = sum.work();
      const std::array<std::uint64_t, 4> now{work.rebuilt, work.new_window, work.pieces, work.candidates};
      if (!again) seen.push_back(now);
      else EXPECT_EQ(now, seen[k - 1]) << k;
      windows += work.new_window;
    }
  }
  EXPECT_GT(windows, 10u);
  EXPECT_LT(windows, 80u);
}

TEST(RotatingSum, stops_on_request) {
  MovingOptions options;
  options.mode = FrameMode::window;
  bool stop = false;
  options.progress = [&](std::string_view, double) { return !stop; };
  RotatingSum sum =
      RotatingSum::create(shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(50, 0.7, 2), options).value();
  ASSERT_TRUE(sum.set(at(0.01)).ok());
  stop = true;
  const Result<FrameChanges> result = sum.set(at(2));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(sum.orientation() == at(0.01));
}

}  // namespace
}  // namespace dymsum
