// Windows: conservative, and shown to be so by breaking them; which path answered.
#include "planar/scaling/window.h"

#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "planar/scaling/scaling_state.h"
#include "planar/scaling_same.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

std::size_t wrong_frames(double shrink) {
  const Region p = on_integers(shapes::noisy_star(60, 0.6, 1), 9000), q = on_integers(shapes::noisy_star(40, 0.6, 2), 5000);
  ScalingOptions options;
  options.mode = ScalingMode::window;
  options.window = 0.5;
  auto base = planar::ScalingBase::create(p, q, 0, 0).value();
  ScalingSum::State state(base, options);
  state.shrink = shrink;
  std::size_t wrong = 0;
  for (int k = 100; k < 145; ++k) {
    EXPECT_TRUE(state.move_to(scale_of(k, 100), scale_of(k, 100)).ok());
    wrong += described(state.sum, exact::BigRational(100)) != static_answer(p, q, k, 100, false, Semantics::closed);
  }
  return wrong;
}

TEST(ScalingWindow, masks_and_pairs_cover_the_whole_sweep) {
  EXPECT_EQ(wrong_frames(1), 0u);
  // Swept over a part of the window only, things are missed: the sweep is what makes the frames right.
  EXPECT_GT(wrong_frames(0.1), 0u);
}

TEST(ScalingWindow, every_candidate_crosses_exactly_where_its_interval_says) {
  const Region p = on_integers(shapes::noisy_star(30, 0.6, 3), 4000), q = on_integers(shapes::noisy_star(20, 0.6, 4), 3000);
  auto base = planar::ScalingBase::create(p, q, 0, 0).value();
  ScalingSum::State state(base, {});
  const auto window = state.window_between(exact::BigRational(1), exact::BigRational(6, 5));
  ASSERT_GT(window->candidates.size(), 40u);
  std::size_t crossing = 0, apart = 0;
  for (const int k : {100, 107, 113, 120}) {
    planar::FramePlace place(base, planar::scale_value(exact::BigRational(k, 100)));
    const double tau = place.tau(window->frame().moving);
    for (const planar::Candidate& c : window->candidates) {
      const planar::Piece &a = window->pieces[c.a], &b = window->pieces[c.b];
      const planar::Meet meet = planar::meet(*window, a.segment, b.segment, place);
      if (tau > c.in_low && tau < c.in_high) {
        EXPECT_EQ(meet, planar::Meet::crossing);
        ++crossing;
      } else if ((tau <= c.out_low || tau >= c.out_high) && !a.head_cut && !a.tail_cut && !b.head_cut && !b.tail_cut) {
        EXPECT_EQ(meet, planar::Meet::none);
        ++apart;
      }
    }
  }
  EXPECT_GT(crossing, 40u);
  EXPECT_GT(apart, 2u);
}

}  // namespace
}  // namespace dymsum
