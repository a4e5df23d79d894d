// Windows that follow one another, that are kept when they are left, and that are made ahead: the sums are those of the
// static engine whichever window a frame is made in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

struct Operands {
  Region p, q;
};

Operands stars() {
  return {on_integers(shapes::noisy_star(60, 0.6, 1), 9000), on_integers(shapes::noisy_star(40, 0.6, 2), 5000)};
}

/// Edges of both are parallel: nodes at every scale, and touches at many of those asked for.
Operands grates() { return {shapes::grate(5, 4, 1, 13), shapes::comb(4, 3, 1, 5)}; }

Operands holes() {
  return {on_integers(shapes::random_polygon(60, 3, 5), 3000), on_integers(shapes::noisy_star(16, 0.6, 4), 500)};
}

/// A state that is requested scales over 4096, and a static engine that answers each time.
class Walk {
 public:
  Walk(const Operands& operands, const MovingOptions& options)
      : operands_(operands),
        state_(planar::pair_of_regions(operands.p, operands.q, planar::PairOptions{.moved = 0}).value(), options) {
    EXPECT_TRUE(state_.begin([&] { return state_.move_to(scale_of(1, 1), scale_of(1, 1)); }).ok());
  }
  /// Whether the frame is right.
  testing::AssertionResult to(long a) {
    const Scale s = scale_of(a, 4096);
    if (!state_.move_to(s, s)) return testing::AssertionFailure() << "no frame";
    windows += state_.work.new_window;
    rebuilt += state_.work.rebuilt;
    degenerate += state_.work.degenerate;
    ++frames;
    if (state_.kept_windows().bytes() > state_.options.kept_window_bytes)
      return testing::AssertionFailure() << "more is kept than granted";
    if (described(state_.sum, exact::BigRational(4096)) !=
        static_answer(operands_.p, operands_.q, double(a), 4096, false, state_.options.semantics))
      return testing::AssertionFailure() << "another sum at " << a << "/4096";
    return testing::AssertionSuccess();
  }
  planar::ScalingState& state() { return state_; }
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0;

 private:
  const Operands& operands_;
  planar::ScalingState state_;
};

MovingOptions with_windows(double width) {
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = width;
  return options;
}

TEST(ScalingWindows, coming_back_costs_no_window) {
  for (const Operands& operands : {stars(), grates(), holes()}) {
    Walk walk(operands, with_windows(0.05));
    for (long a = 4160; a <= 5120; a += 40) ASSERT_TRUE(walk.to(a));
    const std::size_t built = walk.windows;
    EXPECT_GE(built, 3u);
    for (int pass = 0; pass < 2; ++pass) {
      for (long a = 5100; a >= 4160; a -= 28) ASSERT_TRUE(walk.to(a));
      for (long a = 4180; a <= 5120; a += 52) ASSERT_TRUE(walk.to(a));
    }
    EXPECT_EQ(walk.windows, built);
    EXPECT_EQ(walk.rebuilt, 0u);
    EXPECT_EQ(walk.state().kept_windows().size(), built - 1);
  }
}

TEST(ScalingWindows, what_is_kept_stays_within_its_budget) {
  const Operands operands = stars();
  Walk all(operands, with_windows(0.05));
  for (long a = 4160; a <= 6144; a += 64) ASSERT_TRUE(all.to(a));
  const std::uint64_t needed = all.state().kept_windows().bytes();
  const std::size_t kept = all.state().kept_windows().size();
  ASSERT_GE(kept, 5u);
  MovingOptions half = with_windows(0.05), none = half;
  half.kept_window_bytes = needed / 2;
  none.kept_window_bytes = 0;
  Walk some(operands, half), nothing(operands, none);
  for (const int pass : {0, 1})
    for (long k = 0; k <= 31; ++k) {
      const long a = pass == 0 ? 4160 + 64 * k : 6144 - 64 * k;
      ASSERT_TRUE(some.to(a));
      ASSERT_TRUE(nothing.to(a));
      EXPECT_EQ(nothing.state().kept_windows().size(), 0u);
    }
  EXPECT_GT(some.state().kept_windows().size(), 0u);
  EXPECT_LT(some.state().kept_windows().size(), kept);
  // The last ones were there on the way back, the first ones were not.
  EXPECT_GT(some.windows, all.windows);
  EXPECT_LT(some.windows, nothing.windows);
}

/// Scales of all kinds of walks.
class Steps {
 public:
  explicit Steps(std::uint64_t seed) : random_(seed) {}
  long next() {
    if (left_-- == 0) {
      kind_ = random_.below(5);
      left_ = 6 + random_.below(12);
      step_ = 1 + random_.below(80);
    }
    const long sign = random_.chance(50) ? 1 : -1;
    if (kind_ == 0) at_ += random_.below(5) - 2;                    // tiny, or none
    else if (kind_ == 1) at_ = 2048 + random_.below(10000);         // anywhere
    else if (kind_ == 2) at_ += (left_ % 2 == 0 ? 1 : -1) * step_;  // to and fro
    else if (kind_ == 3) at_ += step_;                              // a sweep
    else at_ += sign * random_.below(300);                          // wild
    at_ = std::clamp(at_, 1024L, 20000L);
    return at_;
  }

 private:
  oracles::Random random_;
  long at_ = 4096, kind_ = 0, left_ = 8, step_ = 1;
};

TEST(ScalingWindows, walks_of_all_kinds_equal_the_static_engine) {
  const char* moves = std::getenv("DYMSUM_FUZZ_MOVES");
  const int steps = moves != nullptr ? std::atoi(moves) : 120;
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0;
  std::uint64_t seed = 1;
  for (const Operands& operands : {stars(), grates(), holes()})
    for (const FrameMode mode : {FrameMode::automatic, FrameMode::window})
      for (const int threads : {1, 2})
        for (const std::uint64_t kept : {std::uint64_t{64} << 20, std::uint64_t{300000}}) {
          MovingOptions options;
          options.mode = mode;
          options.threads = threads;
          options.kept_window_bytes = kept;
          Walk walk(operands, options);
          Steps walked(seed++);
          for (int k = 0; k < steps / 3; ++k) ASSERT_TRUE(walk.to(walked.next())) << "walk " << seed << ", step " << k;
          windows += walk.windows;
          rebuilt += walk.rebuilt;
          degenerate += walk.degenerate;
          frames += walk.frames;
        }
  EXPECT_GT(windows, 20u);
  EXPECT_GT(rebuilt, 20u);
  EXPECT_GT(degenerate, 0u);
  EXPECT_GT(frames, windows + rebuilt);
}

TEST(ScalingWindows, a_window_made_ahead_is_entered_without_building_one) {
  const Operands operands = stars();
  MovingOptions options;
  options.threads = 2;
  Walk walk(operands, options);
  // The first window is made on the other thread, and this frame is computed from scratch.
  ASSERT_TRUE(walk.to(4140));
  EXPECT_EQ(walk.rebuilt, 1u);
  EXPECT_EQ(walk.windows, 0u);
  std::set<double> windows;
  for (long a = 4180; a < 6500; a += 40) {
    walk.state().finish_window_ahead();
    ASSERT_TRUE(walk.to(a));
    windows.insert(walk.state().work.window_low);
  }
  EXPECT_EQ(walk.rebuilt, 1u) << "every frame but the first was made in a window that was there";
  EXPECT_EQ(walk.windows, 0u);
  EXPECT_GT(windows.size(), 2u);
}

// At s = 1 all segments of P (+) P have twins there: a window would have to list them all, and serves no frame.
TEST(ScalingWindows, coming_back_to_where_much_touches_builds_no_window) {
  const Region p = on_integers(shapes::noisy_star(60, 0.6, 1), 9000);
  const Operands twins{p, p};
  Walk walk(twins, {});
  for (long a = 4137; a < 4600; a += 41) ASSERT_TRUE(walk.to(a));
  const std::size_t built = walk.windows, rebuilt = walk.rebuilt;
  EXPECT_GT(built, 0u);
  for (long a = 4500; a > 4137; a -= 41) ASSERT_TRUE(walk.to(a));
  ASSERT_TRUE(walk.to(4096));
  EXPECT_TRUE(walk.state().work.rebuilt);
  EXPECT_EQ(walk.windows, built);
  EXPECT_EQ(walk.rebuilt, rebuilt + 1);
  ASSERT_TRUE(walk.to(4141));
  EXPECT_EQ(walk.windows, built) << "the kept one is entered again";
}

TEST(ScalingWindows, scattered_scales_build_no_window_at_the_first_step) {
  const Operands operands = stars();
  Walk walk(operands, {});
  for (const long a : {4400L, 7000L, 4700L, 6100L, 6500L, 5000L}) ASSERT_TRUE(walk.to(a));
  EXPECT_EQ(walk.windows, 0u);
  EXPECT_EQ(walk.rebuilt, walk.frames);
}

// Two close scales in a row are no sweep: steps of one have to be alike.
TEST(ScalingWindows, scattered_scales_build_few_windows_and_sweeps_build_theirs) {
  const Operands operands = stars();
  std::size_t windows = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::vector<long> scales;
    for (double s = 4096; s < 8192; s *= 1.01) scales.push_back(std::lround(s));
    oracles::Random random(seed);
    for (std::size_t i = scales.size(); i > 1; --i)
      std::swap(scales[i - 1], scales[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    ScalingSum sum = ScalingSum::create(operands.p, operands.q).value();
    for (const long a : scales) {
      ASSERT_TRUE(sum.set(scale_of(a, 4096)).ok());
      windows += sum.work().new_window;
    }
  }
  EXPECT_LE(windows, 4u);
  Walk sweep(operands, {});
  for (double s = 4096; s < 8192; s *= 1.03) ASSERT_TRUE(sweep.to(std::lround(s)));
  EXPECT_GE(sweep.windows, 2u);
}

TEST(ScalingWindows, no_frame_waits_for_a_window_that_is_under_way) {
  const Operands operands{on_integers(shapes::noisy_star(150, 0.6, 1), 1 << 16),
                          on_integers(shapes::noisy_star(150, 0.6, 2), 1 << 16)};
  MovingOptions options;
  options.threads = 2;
  Walk walk(operands, options);
  // Whatever is under way at the end is stopped.
  for (const long a : {4140, 4180, 9000, 9040, 4100}) ASSERT_TRUE(walk.to(a));
  EXPECT_GT(walk.rebuilt, 0u);
}

TEST(ScalingWindows, sums_move_with_a_window_under_way) {
  const Operands operands = stars();
  MovingOptions options;
  options.threads = 2;
  ScalingSum sum = ScalingSum::create(operands.p, operands.q, options).value();
  ASSERT_TRUE(sum.set(scale_of(4140, 4096)).ok());
  ScalingSum moved = std::move(sum);
  sum = ScalingSum::create(operands.p, operands.q, options).value();
  ASSERT_TRUE(sum.set(scale_of(8000, 4096)).ok());
  sum = std::move(moved);
  ASSERT_TRUE(sum.set(scale_of(4200, 4096)).ok());
  EXPECT_EQ(described(sum.sum(), exact::BigRational(4096)),
            static_answer(operands.p, operands.q, 4200, 4096, false, Semantics::closed));
}

// Changes account for every ring from window to window, and no identity is used twice.
TEST(ScalingWindows, identities_last_over_windows_that_are_left_and_entered_again) {
  std::size_t all_ended = 0;
  const Operands pockets{on_integers(snapped_shapes::pockets(12, 10), 20000),
                         on_integers(snapped_shapes::disc(16, 1), 900)};
  for (const Operands& operands : {pockets, holes()}) {
    Walk walk(operands, with_windows(0.2));
    Steps steps(7);
    std::vector<std::uint64_t> alive = walk.state().ring_ids, ended;
    std::sort(alive.begin(), alive.end());
    for (int k = 0; k < 150; ++k) {
      const Scale s = scale_of(steps.next(), 4096);
      for (const RingChange& c : walk.state().move_to(s, s).value().rings) {
        const auto it = std::find(alive.begin(), alive.end(), c.ring);
        if (c.kind == RingChange::Kind::appeared) {
          ASSERT_EQ(std::count(ended.begin(), ended.end(), c.ring), 0) << "an identity used again, " << k;
          alive.push_back(c.ring);
          continue;
        }
        ASSERT_NE(it, alive.end()) << k;
        if (c.kind != RingChange::Kind::disappeared) continue;
        ended.push_back(c.ring);
        alive.erase(it);
      }
      std::vector<std::uint64_t> now = walk.state().ring_ids;
      std::sort(now.begin(), now.end());
      std::sort(alive.begin(), alive.end());
      ASSERT_EQ(now, alive) << k;
    }
    all_ended += ended.size();
  }
  EXPECT_GT(all_ended, 10u);
}

TEST(ScalingWindows, a_scale_that_stays_costs_nothing) {
  const Operands operands = stars();
  ScalingSum sum = ScalingSum::create(operands.p, operands.q, with_windows(0.1)).value();
  EXPECT_TRUE(sum.set(1.0).value().rings.empty());
  EXPECT_FALSE(sum.work().new_window);
  EXPECT_FALSE(sum.work().rebuilt);
  ASSERT_TRUE(sum.set(1.25).ok());
  EXPECT_TRUE(sum.work().new_window);
  ASSERT_TRUE(sum.set(1.25).ok());
  EXPECT_FALSE(sum.work().new_window);
  EXPECT_EQ(sum.work().pieces, 0u);
}

}  // namespace
}  // namespace dymsum
