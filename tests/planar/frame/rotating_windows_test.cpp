// Windows of angles that follow one another, that are kept when they are left, and that are made ahead: the sums are
// slices from scratch whichever window a frame is made in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <set>

#include "dymsum/orientation_sum.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "planar/frame/rotating_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

constexpr double kWhole = 2 * std::numbers::pi;

struct Turning {
  Region p, q;
};

Turning turning_stars() { return {shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(40, 0.7, 2)}; }
/// With many loops, so that windows reach back to the frame before.
Turning turning_holes() { return {shapes::random_polygon(80, 5, 3), shapes::noisy_star(16, 0.6, 4)}; }
Turning turning_grates() { return {shapes::grate(5, 4, 1, 13), shapes::comb(4, 3, 1, 5)}; }

/// A state that turns, and slices from scratch.
class TurningWalk {
 public:
  TurningWalk(const Turning& operands, const MovingOptions& options)
      : operands_(operands), state_(made(operands, options)) {
    EXPECT_TRUE(state_->begin([&] { return state_->move_to(Orientation()); }).ok());
  }
  /// Whether the frame is right.
  testing::AssertionResult to(double radians) {
    const Orientation theta = Orientation::nearest(radians, 1e-7).value();
    if (!state_->move_to(theta)) return testing::AssertionFailure() << "no frame";
    windows += state_->work.new_window;
    rebuilt += state_->work.rebuilt;
    degenerate += state_->work.degenerate;
    ++frames;
    if (state_->kept_windows().bytes() > state_->options.kept_window_bytes)
      return testing::AssertionFailure() << "more is kept than granted";
    if (!(state_->sum == rotated_sum(operands_.p, operands_.q, theta).value()))
      return testing::AssertionFailure() << "another sum at " << radians;
    return testing::AssertionSuccess();
  }
  planar::RotatingState& state() { return *state_; }
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0;

 private:
  static std::unique_ptr<planar::RotatingState> made(const Turning& operands, const MovingOptions& options) {
    const auto base = planar::pair_of_regions(operands.p, operands.q, options).value();
    // With the smaller operand as operand 1.
    planar::PairOptions other;
    other.moved = 1;
    const auto forms = planar::RotatingState::p_is_smaller(*base)
                           ? planar::pair_of_regions(operands.q, operands.p, other).value()
                           : base;
    return std::make_unique<planar::RotatingState>(base, forms, options);
  }

  const Turning& operands_;
  std::unique_ptr<planar::RotatingState> state_;
};

MovingOptions windows_of(double width) {
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = width;
  return options;
}

TEST(RotatingWindows, turning_back_costs_no_window) {
  for (const Turning& operands : {turning_stars(), turning_holes(), turning_grates()}) {
    TurningWalk walk(operands, windows_of(0.08));
    for (double a = 0.3; a < 1.3; a += 0.03) ASSERT_TRUE(walk.to(a));
    const std::size_t built = walk.windows;
    EXPECT_GE(built, 5u);
    // Other angles than those on the way there: windows leave no gap.
    for (int pass = 0; pass < 2; ++pass) {
      for (double a = 1.27; a > 0.3; a -= 0.021) ASSERT_TRUE(walk.to(a));
      for (double a = 0.31; a < 1.28; a += 0.037) ASSERT_TRUE(walk.to(a));
    }
    EXPECT_EQ(walk.windows, built);
    EXPECT_EQ(walk.rebuilt, walk.degenerate);
    EXPECT_EQ(walk.state().kept_windows().size(), built - 1);
  }
}

// Beyond half a turn of width segments come and go twice in a window. It has room for them once.
TEST(RotatingWindows, sums_are_right_however_wide_windows_are_asked_for) {
  const auto region = [](const Ring& ring) { return Region::create({{{ring, {}}}, {}, {}}).value(); };
  const Turning operands{region({{-2, -3}, {1, 1}, {-1, 2}}), region({{1, 0}, {-0.5, 0.875}, {-0.5, -0.875}})};
  for (const double width : {1.5, 2.0, 3.0, 3.2, 5.0, kWhole, 1e3, 1e300, std::numeric_limits<double>::max()}) {
    TurningWalk walk(operands, windows_of(width));
    for (const double a : {0.01, 0.4, -0.9, -0.8, 3.1, 3.2, -2.0, 1.0}) {
      ASSERT_TRUE(walk.to(a)) << width;
      const FrameWork& work = walk.state().work;
      EXPECT_LT(work.window_high - work.window_low, 2) << width;
    }
    EXPECT_EQ(walk.rebuilt, walk.degenerate);
  }
}

TEST(RotatingWindows, a_segment_exists_once_within_a_quarter_turn) {
  for (const Turning& operands : {turning_stars(), turning_holes(), turning_grates()}) {
    const auto pair = planar::pair_of_regions(operands.p, operands.q, planar::PairOptions{.moved = 1}).value();
    const planar::TurnedOperands turned(pair);
    std::size_t existing = 0;
    for (const double theta : {0.0, 0.7, 2.9, -1.3})
      turned.catalog.for_each(theta - 1.57, theta + 1.57, [&](const planar::WalkSegment& s) {
        const planar::RotationCatalog::Span span = turned.catalog.span(s, theta);
        for (double by = -1.57; by < 1.57; by += 0.05) {
          const auto exists = turned.catalog.exists(s, theta + by);
          if (exists == planar::RotationCatalog::Existence::unsure) continue;
          existing += exists == planar::RotationCatalog::Existence::yes;
          ASSERT_EQ(exists == planar::RotationCatalog::Existence::yes, span.from < by && by < span.to);
        }
      });
    EXPECT_GT(existing, 1000u);
  }
}

TEST(RotatingWindows, a_second_whole_turn_finds_the_windows_of_the_first) {
  const Turning operands = turning_stars();
  for (const double sign : {1.0, -1.0}) {
    TurningWalk walk(operands, windows_of(0.15));
    const auto turn = [&](double offset) {
      for (int k = 1; k <= 70; ++k) ASSERT_TRUE(walk.to(sign * (offset + k * kWhole / 70)));
    };
    turn(0);
    const std::size_t built = walk.windows;
    EXPECT_GE(built, 30u);
    turn(0);
    turn(0.04);
    EXPECT_LE(walk.windows, built + 1) << "the turn may end between the last window and the first";
  }
}

TEST(RotatingWindows, what_is_kept_stays_within_its_budget) {
  const Turning operands = turning_stars();
  TurningWalk all(operands, windows_of(0.05));
  for (int k = 1; k <= 32; ++k) ASSERT_TRUE(all.to(0.04 * k));
  const std::uint64_t needed = all.state().kept_windows().bytes();
  const std::size_t kept = all.state().kept_windows().size();
  ASSERT_GE(kept, 8u);
  EXPECT_GT(needed / kept, 60u * 40) << "a window holds its segments at least";
  MovingOptions half = windows_of(0.05), none = half, tiny = half;
  half.kept_window_bytes = needed / 2;
  none.kept_window_bytes = 0;
  tiny.kept_window_bytes = 1000;
  TurningWalk some(operands, half), nothing(operands, none), hardly(operands, tiny);
  for (const int pass : {0, 1})
    for (int k = 1; k <= 32; ++k) {
      const double a = 0.04 * (pass == 0 ? k : 33 - k);
      ASSERT_TRUE(some.to(a));
      ASSERT_TRUE(nothing.to(a));
      ASSERT_TRUE(hardly.to(a));
      EXPECT_EQ(nothing.state().kept_windows().size(), 0u);
      EXPECT_EQ(hardly.state().kept_windows().size(), 0u);
    }
  EXPECT_GT(some.state().kept_windows().size(), 0u);
  EXPECT_LT(some.state().kept_windows().size(), kept);
  EXPECT_GT(some.windows, all.windows);
  EXPECT_LT(some.windows, nothing.windows);
  EXPECT_EQ(hardly.windows, nothing.windows);
}

TEST(RotatingWindows, a_window_counts_its_lists) {
  const auto base =
      planar::pair_of_regions(turning_stars().p, turning_stars().q, planar::PairOptions{.moved = 1}).value();
  const planar::TurnedOperands operands(base);
  const planar::RotationGrid grid(operands.forms, 32);
  const planar::RotatingWindow w(grid, operands.catalog, 0.3, 0.02, true);
  const std::size_t lists =
      w.segments.size() * sizeof(planar::RotatingSegment) + w.pieces.size() * sizeof(planar::RotatingPiece) +
      w.candidates.size() * sizeof(planar::RotationCandidate) + w.turned.size() * sizeof(Point) +
      4 * (w.first_of.size() + w.of.size() + w.changing.size() + w.rounds.size() + w.circles.size());
  EXPECT_GE(w.bytes(), lists + 8 * (operands.forms.size(0) + operands.forms.size(1)));
  EXPECT_LE(w.bytes(), 2 * lists) << "and not much that is not used";
}

/// Angles of all kinds of walks.
class TurningSteps {
 public:
  explicit TurningSteps(std::uint64_t seed) : random_(seed) {}
  double next() {
    if (left_-- == 0) {
      kind_ = random_.below(6);
      left_ = 6 + random_.below(12);
      step_ = 0.001 * static_cast<double>(1 + random_.below(30));
    }
    const double sign = random_.chance(50) ? 1 : -1;
    if (kind_ == 0) at_ += sign * 1e-7 * static_cast<double>(random_.below(3));   // tiny, or none
    else if (kind_ == 1) at_ = 0.001 * static_cast<double>(random_.below(6284));  // anywhere
    else if (kind_ == 2) at_ += left_ % 2 == 0 ? step_ : -step_;                  // to and fro
    else if (kind_ == 3) at_ += step_;                                            // a sweep
    else if (kind_ == 4) at_ -= step_;
    else at_ = 0.5 * std::numbers::pi * static_cast<double>(random_.below(4)) + sign * 0.1 * step_;  // quarter turns
    return at_;
  }

 private:
  oracles::Random random_;
  double at_ = 0, step_ = 0.01;
  std::uint64_t kind_ = 0, left_ = 8;
};

TEST(RotatingWindows, walks_of_all_kinds_equal_slices) {
  const char* moves = std::getenv("DYMSUM_FUZZ_MOVES");
  const int steps = moves != nullptr ? std::atoi(moves) / 10 : 60;
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0, kept = 0;
  std::uint64_t seed = 1;
  for (const Turning& operands : {turning_stars(), turning_holes(), turning_grates()})
    for (const FrameMode mode : {FrameMode::automatic, FrameMode::window})
      for (const int threads : {1, 2})
        for (const std::uint64_t bytes : {std::uint64_t{64} << 20, std::uint64_t{100000}}) {
          MovingOptions options;
          options.mode = mode;
          options.threads = threads;
          options.kept_window_bytes = bytes;
          TurningWalk walk(operands, options);
          TurningSteps walked(seed++);
          for (int k = 0; k < steps; ++k) ASSERT_TRUE(walk.to(walked.next())) << "walk " << seed << ", step " << k;
          windows += walk.windows;
          rebuilt += walk.rebuilt;
          degenerate += walk.degenerate;
          frames += walk.frames;
          kept += walk.state().kept_windows().size();
        }
  EXPECT_GT(windows, 20u);
  EXPECT_GT(rebuilt, 20u);
  EXPECT_GT(degenerate, 0u);
  EXPECT_GT(kept, 20u);
  EXPECT_GT(frames, windows + rebuilt);
}

TEST(RotatingWindows, a_window_made_ahead_is_entered_without_building_one) {
  for (const Turning& operands : {turning_stars(), turning_holes()})
    for (const double sign : {1.0, -1.0}) {
      MovingOptions options;
      options.threads = 2;
      TurningWalk walk(operands, options);
      ASSERT_TRUE(walk.to(sign * 0.006));
      EXPECT_EQ(walk.rebuilt, 1u);
      std::set<double> windows;
      for (int k = 2; k < 60; ++k) {
        walk.state().finish_window_ahead();
        ASSERT_TRUE(walk.to(sign * 0.006 * k));
        if (!walk.state().work.rebuilt) windows.insert(walk.state().work.window_low);
      }
      EXPECT_EQ(walk.rebuilt, 1 + walk.degenerate);
      EXPECT_EQ(walk.windows, 0u);
      EXPECT_GT(windows.size(), 2u);
    }
}

TEST(RotatingWindows, sums_are_moved_stopped_and_destroyed_with_a_window_under_way) {
  const Turning operands{shapes::noisy_star(150, 0.6, 1), shapes::noisy_star(150, 0.6, 2)};
  MovingOptions options;
  options.threads = 2;
  bool stop = false;
  options.progress = [&stop](std::string_view, double) { return !stop; };
  const auto at = [](double radians) { return Orientation::nearest(radians, 1e-7).value(); };
  RotatingSum sum = RotatingSum::create(operands.p, operands.q, options).value();
  ASSERT_TRUE(sum.set(at(0.002)).ok());
  RotatingSum moved = std::move(sum);
  sum = RotatingSum::create(operands.p, operands.q, options).value();
  ASSERT_TRUE(sum.set(at(1.002)).ok());
  sum = std::move(moved);
  stop = true;
  const Result<FrameChanges> stopped = sum.set(at(2));
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(sum.orientation() == at(0.002)) << "nothing changes";
  stop = false;
  ASSERT_TRUE(sum.set(at(0.003)).ok());
  EXPECT_TRUE(sum.sum() == rotated_sum(operands.p, operands.q, at(0.003)).value());
}

}  // namespace
}  // namespace dymsum
