// Non-uniform scales of one ratio, diag(s, r s): windows serve them, and the sums are those of the static engine on
// integers, which knows nothing of ratios, windows or stretched operands.
#include <gtest/gtest.h>

#include <cstdlib>
#include <tuple>

#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/random.h"
#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

struct RatioShapes {
  Region p, q;
};

RatioShapes two_stars() {
  return {on_integers(shapes::noisy_star(60, 0.6, 1), 9000), on_integers(shapes::noisy_star(40, 0.6, 2), 5000)};
}

std::vector<RatioShapes> ratio_shapes() {
  return {two_stars(),
          {shapes::grate(5, 4, 1, 13), shapes::comb(4, 3, 1, 5)},
          {on_integers(shapes::random_polygon(60, 3, 5), 3000), on_integers(shapes::noisy_star(16, 0.6, 4), 500)}};
}

struct Ratio {
  long num, den;
};

/// diag(s, s num / den) for s = a / 4096.
constexpr long kSteps = 4096;

/// A state that is requested such scales, and a static engine that answers each time.
class RatioWalk {
 public:
  RatioWalk(const RatioShapes& shapes, const MovingOptions& options)
      : shapes_(shapes),
        q_scales_(options.moving == MovingOperand::q),
        reflected_(options.reflect_q),
        state_(planar::pair_of_regions(shapes.p, shapes.q, options).value(), options) {
    state_.options.mode = FrameMode::rebuild;  // as sums are made
    EXPECT_TRUE(state_.move_to(Scale(), Scale()).ok());
    state_.options.mode = options.mode;
  }
  testing::AssertionResult to(long a, Ratio r) {
    if (!state_.move_to(scale_of(a, kSteps), scale_of(a * r.num, kSteps * r.den)))
      return testing::AssertionFailure() << "no frame";
    windows += state_.work.new_window;
    rebuilt += state_.work.rebuilt;
    degenerate += state_.work.degenerate;
    ++frames;
    const auto [p, q] = on_integers_at(a, r);
    SumOptions options;
    options.semantics = state_.options.semantics;
    if (described(state_.sum, exact::BigRational(kSteps * r.den)) !=
        described(minkowski_sum(p, q, options).value(), exact::BigRational(1)))
      return testing::AssertionFailure() << "another sum at " << a << "/4096, ratio " << r.num << "/" << r.den;
    return testing::AssertionSuccess();
  }
  /// The operands at a scale, times the common denominator.
  std::pair<Region, Region> on_integers_at(long a, Ratio r) const {
    const double x = double(a * r.den), y = double(a * r.num), rest = double(kSteps * r.den);
    const double turn = reflected_ ? -1 : 1;
    return {multiplied(shapes_.p, q_scales_ ? rest : x, q_scales_ ? rest : y),
            multiplied(shapes_.q, turn * (q_scales_ ? x : rest), turn * (q_scales_ ? y : rest))};
  }
  planar::ScalingState& state() { return state_; }
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0;

 private:
  const RatioShapes& shapes_;
  bool q_scales_, reflected_;
  planar::ScalingState state_;
};

MovingOptions ratio_windows(double width) {
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = width;
  return options;
}

TEST(ScalingRatio, one_window_serves_the_scales_of_one_ratio) {
  for (const RatioShapes& shapes : ratio_shapes())
    for (const Ratio r : {Ratio{1, 3}, Ratio{7, 5}, Ratio{100, 137}}) {
      RatioWalk walk(shapes, ratio_windows(0.1));
      for (long a = 4100; a <= 4400; a += 25) ASSERT_TRUE(walk.to(a, r));
      EXPECT_EQ(walk.windows, 1u);
      EXPECT_EQ(walk.rebuilt, 1u) << "the first one, which comes from another ratio";
    }
}

TEST(ScalingRatio, other_ratios_are_computed_from_scratch_and_windows_stay) {
  const RatioShapes shapes = two_stars();
  RatioWalk walk(shapes, ratio_windows(0.2));
  const auto sweep = [&](Ratio r) {
    for (long a = 4200; a <= 4400; a += 40) ASSERT_TRUE(walk.to(a, r));
  };
  for (const Ratio r : {Ratio{1, 1}, Ratio{2, 3}, Ratio{3, 2}}) sweep(r);
  const std::size_t windows = walk.windows, rebuilt = walk.rebuilt;
  EXPECT_EQ(windows, 3u);
  EXPECT_EQ(rebuilt, 2u);
  // Back to each of them: frames only.
  for (const Ratio r : {Ratio{2, 3}, Ratio{1, 1}, Ratio{3, 2}}) sweep(r);
  EXPECT_EQ(walk.windows, windows);
  EXPECT_EQ(walk.rebuilt, rebuilt);
  // A ratio of its own each time: only 11/11 has a window.
  for (long k = 0; k < 7; ++k) ASSERT_TRUE(walk.to(4300, {8 + k, 11}));
  EXPECT_EQ(walk.windows, windows);
  EXPECT_EQ(walk.rebuilt, rebuilt + 6);
}

/// Scales and ratios of all kinds of walks.
class RatioSteps {
 public:
  explicit RatioSteps(std::uint64_t seed) : random_(seed) {}
  std::pair<long, Ratio> next() {
    if (left_-- == 0) {
      kind_ = random_.below(6);
      left_ = 6 + random_.below(12);
      step_ = 1 + random_.below(80);
      if (random_.chance(60)) ratio_ = kRatios[random_.below(5)];
    }
    const long sign = random_.chance(50) ? 1 : -1;
    if (kind_ == 0) at_ += random_.below(5) - 2;                    // tiny, or none
    else if (kind_ == 1) at_ = 2048 + random_.below(6000);          // anywhere
    else if (kind_ == 2) at_ += (left_ % 2 == 0 ? 1 : -1) * step_;  // to and fro
    else if (kind_ == 3) at_ += step_;                              // a sweep
    else if (kind_ == 4) ratio_ = kRatios[random_.below(5)];        // another ratio each time
    else at_ += sign * random_.below(300);                          // wild
    at_ = std::clamp(at_, 1024L, 12000L);
    return {at_, ratio_};
  }

 private:
  static constexpr Ratio kRatios[] = {{1, 1}, {1, 2}, {4, 3}, {9, 10}, {5, 1}};
  oracles::Random random_;
  long at_ = 4096, kind_ = 0, left_ = 8, step_ = 1;
  Ratio ratio_{3, 4};
};

TEST(ScalingRatio, walks_of_all_kinds_equal_the_static_engine) {
  const char* moves = std::getenv("DYMSUM_FUZZ_MOVES");
  const int steps = moves != nullptr ? std::atoi(moves) : 120;
  std::size_t windows = 0, rebuilt = 0, degenerate = 0, frames = 0;
  std::uint64_t seed = 1;
  for (const RatioShapes& shapes : ratio_shapes())
    for (const FrameMode mode : {FrameMode::automatic, FrameMode::window})
      for (const int threads : {1, 2})
        for (const MovingOperand moving : {MovingOperand::p, MovingOperand::q}) {
          MovingOptions options;
          options.mode = mode;
          options.threads = threads;
          options.moving = moving;
          options.reflect_q = seed % 3 == 0;
          options.kept_window_bytes = seed % 2 == 0 ? 300000 : std::uint64_t{64} << 20;
          RatioWalk walk(shapes, options);
          RatioSteps walked(seed++);
          for (int k = 0; k < steps / 3; ++k) {
            const auto [a, ratio] = walked.next();
            ASSERT_TRUE(walk.to(a, ratio)) << "walk " << seed << ", step " << k;
          }
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

TEST(ScalingRatio, a_window_made_ahead_serves_its_ratio) {
  const RatioShapes shapes = two_stars();
  MovingOptions options;
  options.threads = 2;
  RatioWalk walk(shapes, options);
  const Ratio r{3, 5};
  ASSERT_TRUE(walk.to(4096, r));
  ASSERT_TRUE(walk.to(4140, r));
  EXPECT_EQ(walk.rebuilt, 2u);
  for (long a = 4180; a < 5500; a += 40) {
    walk.state().finish_window_ahead();
    ASSERT_TRUE(walk.to(a, r));
  }
  EXPECT_EQ(walk.rebuilt, 2u);
  EXPECT_EQ(walk.windows, 0u);
  // The window under way is of another ratio than these.
  for (long a = 5500; a < 5700; a += 40) {
    ASSERT_TRUE(walk.to(a, {5, 3}));
    walk.state().finish_window_ahead();
  }
  EXPECT_EQ(walk.rebuilt, 4u);
}

// Beyond 2^32 products of doubles might underflow in windows: every frame from scratch. Within, windows serve.
TEST(ScalingRatio, extreme_ratios_are_right_too) {
  const RatioShapes shapes{on_integers(shapes::noisy_star(12, 0.6, 1), 60),
                           on_integers(shapes::noisy_star(9, 0.6, 2), 40)};
  for (const int bits : {-33, -32, -20, 20, 32, 33}) {
    ScalingSum sum = ScalingSum::create(shapes.p, shapes.q, ratio_windows(0.1)).value();
    std::size_t rebuilt = 0;
    for (int k = 0; k < 8; ++k) {
      const double s = 1 + k / 256.0, power = std::ldexp(1.0, bits);
      ASSERT_TRUE(sum.set(Scale::of(s).value(), Scale::of(s * power).value()).ok());
      rebuilt += sum.work().rebuilt;
      const PlanarSum fresh =
          minkowski_sum(multiplied(shapes.p, 256 * s, 256 * s * power), multiplied(shapes.q, 256, 256)).value();
      EXPECT_EQ(described(sum.sum(), exact::BigRational(256)), described(fresh, exact::BigRational(1))) << bits;
    }
    EXPECT_EQ(rebuilt, std::abs(bits) > 32 ? 8u : 1u) << bits;
  }
}

// The exact layer takes the mediant of two cuts by its integers, which have the ratio's denominator among their
// factors.
TEST(ScalingRatio, samples_of_loops_are_where_the_exact_layer_has_them) {
  std::size_t mixed = 0;
  for (const RatioShapes& shapes : ratio_shapes()) {
    const auto plain = planar::pair_of_regions(shapes.p, shapes.q, planar::PairOptions{.moved = 0}).value();
    planar::RatioSweeps sweeps;
    const planar::Factors factors =
        planar::factors_of(planar::scale_value(Scale()), planar::scale_value(scale_of(100, 137)));
    planar::RatioSweep& sweep = *sweeps.make(*plain, factors);
    const auto frames = planar::window_frames(sweep.windows.plan(1.1, 1.3, 1.2, UINT64_MAX));
    const planar::LoopPositions positions(frames->lists);
    for (long a = 1105; a < 1295; a += 5) {
      planar::ExactFrame frame(sweep.base, planar::scale_value(scale_of(a, 1000)));
      FrameWork work;
      if (!frames->follow(frame, work)) continue;
      for (const planar::FrameLoop& loop : frames->loops.loops()) {
        const planar::SegmentPosition p =
            positions.sample(loop.steps, frame.tau(frames->window->frame().moving), frame);
        const planar::Lattice::Position at = frame.lattice().position(p);
        const Point& offset = plain->lattice->points[1]->offset;  // P has none
        mixed += p.first.kind != p.second.kind;
        for (const auto& [truth, value, from] : {std::tuple{at.x, p.x, offset.x}, {at.y, p.y, offset.y}}) {
          const exact::BigRational off = truth - exact::exact_value(from) - exact::exact_value(value);
          EXPECT_LE(exact::BigRational(abs(off)), exact::exact_value(p.error));
        }
      }
    }
  }
  EXPECT_GT(mixed, 0u) << "of a vertex and a crossing";
}

/// Whether a point lies inside the rings of a sum: crossings of a ray, exactly. Requires: not on a ring.
bool inside_rings(const PlanarSum& sum, const exact::BigRational& x, const exact::BigRational& y) {
  bool inside = false;
  const auto ring = [&](const SumRing& r) {
    for (std::size_t i = 0; i < r.vertices.size(); ++i) {
      const RationalPoint a = sum.exact(r.vertices[i]), b = sum.exact(r.vertices[(i + 1) % r.vertices.size()]);
      const exact::BigRational ax = exact::exact_value(a.x), ay = exact::exact_value(a.y), bx = exact::exact_value(b.x),
                               by = exact::exact_value(b.y);
      if ((ay > y) == (by > y)) continue;
      inside ^= x < ax + (y - ay) / (by - ay) * (bx - ax);
    }
  };
  for (const SumPart& part : sum.parts) {
    ring(part.outer);
    for (const SumRing& hole : part.holes) ring(hole);
  }
  return inside;
}

TEST(ScalingRatio, frames_of_windows_hold_what_the_definition_says) {
  const RatioShapes shapes{on_integers(shapes::random_polygon(40, 2, 5), 3000),
                           on_integers(shapes::noisy_star(12, 0.6, 4), 500)};
  RatioWalk walk(shapes, ratio_windows(0.3));
  const Ratio r{2, 3};
  oracles::Random random(5);
  std::size_t in = 0, out = 0;
  for (long a = 4200; a <= 5000; a += 200) {
    ASSERT_TRUE(walk.to(a, r));
    const auto [p, q] = walk.on_integers_at(a, r);
    const oracles::Membership<oracles::Big> definition(p.data(), q.data());
    const auto box = bounds(shapes.p);
    for (int k = 0; k < 60; ++k) {
      const double b = double(kSteps * r.den), x = std::round(std::abs(random.signed_unit()) * 1.4 * box[2] * b),
                   y = std::round(std::abs(random.signed_unit()) * box[3] * b);
      const oracles::Pt<oracles::Big> z{oracles::from_double<oracles::Big>(x), oracles::from_double<oracles::Big>(y)};
      if (definition.meets(z) != definition.overlaps(z)) continue;  // on the boundary
      const bool is = inside_rings(walk.state().sum, exact::exact_value(x) / exact::exact_value(b),
                                   exact::exact_value(y) / exact::exact_value(b));
      EXPECT_EQ(is, definition.overlaps(z));
      ++(is ? in : out);
    }
  }
  EXPECT_EQ(walk.rebuilt, 1u);
  EXPECT_GT(in, 20u);
  EXPECT_GT(out, 20u);
}

}  // namespace
}  // namespace dymsum
