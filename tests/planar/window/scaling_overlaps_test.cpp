// Edges of one operand on one line: segments of the convolution lie along each other at every scale, and what crosses
// one crosses several at one position. Windows let one of them go on, so that such frames need no vertex routine; all
// frames equal the static engine.
#include <gtest/gtest.h>

#include <random>

#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

struct Shared {
  std::uint64_t handed_on = 0, covered = 0;
};

Shared shared_pieces(const Region& p, const Region& q) {
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  planar::ScalingState state(base, {});
  const auto window = state.windows.between(exact::BigRational(21, 20), exact::BigRational(23, 20));
  Shared count;
  for (const planar::Piece& piece : window->pieces) {
    count.handed_on += piece.handed_on && !piece.covered;
    count.covered += piece.covered;
  }
  return count;
}

TEST(ScalingOverlaps, skylines_equal_the_static_engine_between_events_and_at_them) {
  std::mt19937 random(5);
  Shared shared;
  std::uint64_t between = 0, updated = 0, near = 0, near_updated = 0;
  for (int round = 0; round < 160; ++round) {
    const Region p = skylines(random, 3 + round % 7, round % 3 == 1),
                 q = skylines(random, 3 + round % 5, round % 2 == 1);
    const Shared s = shared_pieces(p, q);
    shared.handed_on += s.handed_on;
    shared.covered += s.covered;
    MovingOptions options;
    options.mode = FrameMode::window;
    options.window = round % 4 == 0 ? 0.6 : 0.15;
    options.semantics = round % 3 == 0 ? Semantics::closed : round % 3 == 1 ? Semantics::open : Semantics::regular;
    options.moving = round % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    ScalingSum sum = ScalingSum::create(p, q, options).value();
    // Quarters and halves are events of integer shapes; 997 divides nothing. Just beside events doubles do not
    // determine where a piece ends.
    for (int k = 0; k < 18; ++k) {
      const bool event = k % 3 == 2;
      const long fine = k % 6 == 5 ? 1L << 43 : 1, beside = fine == 1 ? 0 : k % 4 < 2 ? 1 : -1;
      const long a = event ? (4 + k) * fine + beside : 900 + 61 * k, b = event ? 4 * fine : 997;
      ASSERT_TRUE(sum.set(scale_of(a, b)).ok());
      between += !event;
      near += beside != 0;
      near_updated += beside != 0 && !sum.work().degenerate;
      updated += !event && !sum.work().degenerate;
      ASSERT_EQ(described(sum.sum(), exact::BigRational(b)),
                static_answer(p, q, static_cast<double>(a), static_cast<double>(b), round % 2 == 1, options.semantics))
          << round << " " << k;
    }
  }
  EXPECT_GT(shared.handed_on, 100u);
  EXPECT_GT(shared.covered, 20u);
  // The rest touches itself at every scale in other ways: tight points, or a boundary that passes a node twice.
  EXPECT_GT(updated, between * 4 / 5);
  EXPECT_GT(near_updated, near * 4 / 5);
}

TEST(ScalingOverlaps, crossing_combs_are_updated_without_the_vertex_routine) {
  const std::vector<double> wide{0, 9, 18, 27, 36}, narrow{0, 3, 6};
  const Region p = comb(wide, 60, false), q = comb(narrow, 50, true);
  MovingOptions options;
  options.mode = FrameMode::window;
  ScalingSum sum = ScalingSum::create(p, q, options).value();
  std::uint64_t degenerate = 0;
  for (int k = 0; k < 60; ++k) {
    const long a = 997 + 13 * k;
    ASSERT_TRUE(sum.set(scale_of(a, 997)).ok());
    degenerate += sum.work().degenerate;
    ASSERT_EQ(described(sum.sum(), exact::BigRational(997)),
              static_answer(p, q, static_cast<double>(a), 997, false, Semantics::closed))
        << k;
  }
  EXPECT_LE(degenerate, 1u);  // s = 1
}

TEST(ScalingOverlaps, combs_with_masks_and_random_jumps_equal_the_static_engine) {
  std::mt19937 random(8);
  std::vector<double> bars, others;
  for (int i = 0; i < 24; ++i) bars.push_back(5.0 * i + static_cast<double>(random() % 3));
  for (int i = 0; i < 9; ++i) others.push_back(4.0 * i + static_cast<double>(random() % 2));
  for (const bool upright : {false, true}) {
    const Region p = comb(bars, 40, false), q = comb(others, 12, upright);
    MovingOptions options;
    options.mode = FrameMode::window;
    options.window = 0.05;
    ScalingSum sum = ScalingSum::create(p, q, options).value();
    long a = 1009;
    for (int k = 0; k < 40; ++k) {
      a = std::max(600L, a + static_cast<long>(random() % 41) - 18);
      ASSERT_TRUE(sum.set(scale_of(a, 997)).ok());
      ASSERT_EQ(described(sum.sum(), exact::BigRational(997)),
                static_answer(p, q, static_cast<double>(a), 997, false, Semantics::closed))
          << k;
    }
  }
}

}  // namespace
}  // namespace dymsum
