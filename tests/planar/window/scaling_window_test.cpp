// Windows: conservative, and shown to be so by breaking them; which path answered.
#include "planar/motion/operand_pair.h"
#include "planar/window/window_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

std::size_t wrong_frames(double shrink) {
  const Region p = on_integers(shapes::noisy_star(60, 0.6, 1), 9000),
               q = on_integers(shapes::noisy_star(40, 0.6, 2), 5000);
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.5;
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  planar::ScalingState state(base, options);
  state.windows.shrink = shrink;
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
  const Region p = on_integers(shapes::noisy_star(30, 0.6, 3), 4000),
               q = on_integers(shapes::noisy_star(20, 0.6, 4), 3000);
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  planar::ScalingState state(base, {});
  const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(6, 5));
  ASSERT_GT(window->candidates.size(), 40u);
  std::size_t crossing = 0, apart = 0;
  for (const int k : {100, 107, 113, 120}) {
    planar::ExactFrame position(base, planar::scale_value(exact::BigRational(k, 100)));
    const double tau = position.tau(window->frame().moving);
    for (const planar::Candidate& c : window->candidates) {
      const planar::Piece &a = window->pieces[c.a], &b = window->pieces[c.b];
      const planar::Meet meet = planar::meet(*window, a.segment, b.segment, position);
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

/// A plate with a square hole; every edge on a line of the grid that the tests below lay over it.
Region plate(double size, double low, double high) {
  RegionData data;
  data.parts.push_back(
      {{{0, 0}, {size, 0}, {size, size}, {0, size}}, {{{low, low}, {low, high}, {high, high}, {high, low}}}});
  return Region::create(std::move(data)).value();
}

/// Dead cells beside live ones: how many there are, and how many of them do not lie in the open sum with the rim that
/// they promise.
std::pair<int, int> covered_cells_and_wrong_ones(const Region& p, const Region& q, planar::WindowFrame frame,
                                                 int cells) {
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 1}).value();
  frame.centre_x = base->width[frame.moving] / 2;
  frame.centre_y = base->height[frame.moving] / 2;
  const planar::CoveredCells mask = planar::swept_cells(*base, frame, cells, true);
  const planar::Grid& g = mask.grid();
  int dead = 0, wrong = 0;
  for (const double tau : {frame.tau0, 0.5 * (frame.tau0 + frame.tau1), frame.tau1}) {
    const oracles::Membership<oracles::Big> sum(frame.moving == 0 ? multiplied(p, tau, tau).data() : p.data(),
                                                frame.moving == 1 ? multiplied(q, tau, tau).data() : q.data());
    for (int row = 1; row + 1 < g.rows; ++row)
      for (int column = 1; column + 1 < g.columns; ++column) {
        if (!mask.covered(row, column) || !mask.any_live(row - 1, column - 1, row + 1, column + 1)) continue;
        ++dead;
        const double rim = 8 * planar::kReach;
        bool inside = true;
        for (const double y : {row - rim, row + 1 + rim})
          for (const double x : {column - rim, column + 1 + rim})
            inside &= sum.overlaps({oracles::from_double<oracles::Big>(x * g.cell - frame.shift_x(tau)),
                                    oracles::from_double<oracles::Big>(y * g.cell - frame.shift_y(tau))});
        wrong += !inside;
      }
  }
  return {dead, wrong};
}

TEST(ScalingWindow, covered_cells_lie_in_the_open_sum_with_their_rim_at_every_scale) {
  const auto check = [](const Region& p, const Region& q, std::uint32_t moving, double tau0, double tau1, int cells) {
    const auto [dead, wrong] = covered_cells_and_wrong_ones(p, q, {moving, tau0, tau1, 0, 0}, cells);
    EXPECT_GT(dead, 20);
    EXPECT_EQ(wrong, 0) << cells << " cells from " << tau0 << " to " << tau1;
  };
  // Cells of size 1, edges on their borders at both ends of the window: without a rim, cells would end where the sum
  // does.
  check(plate(32, 8, 24), shapes::rectangle(0, 0, 16, 16), 1, 2, 2, 64);
  check(plate(32, 8, 24), shapes::rectangle(0, 0, 16, 16), 1, 1.75, 2, 64);
  check(plate(32, 8, 24), plate(16, 4, 12), 1, 1.75, 2, 64);
  check(shapes::rectangle(0, 0, 16, 16), plate(32, 8, 24), 0, 1.5, 2, 64);
  // A hole that grows through cells that were inside at the window's start.
  check(shapes::rectangle(0, 0, 4, 4), plate(16, 4, 12), 1, 1.25, 2, 72);
  // And anywhere.
  check(on_integers(shapes::noisy_star(20, 0.5, 1), 3000), on_integers(shapes::noisy_star(11, 0.5, 2), 2000), 1, 1,
        1.125, 60);
}

/// A point of the sum of k P and 100 Q for walk vertices of both.
oracles::Pt<oracles::Big> corner(const planar::OperandPair& base, planar::WalkPair at, int k) {
  const planar::Lattice& l = *base.lattice;
  const auto value = [&](double x, double offset) { return oracles::Big(exact::exact_value(x * l.unit + offset)); };
  const double px = base.operands[0].x[at.p], py = base.operands[0].y[at.p], qx = base.operands[1].x[at.q],
               qy = base.operands[1].y[at.q];
  return {k * value(px, l.points[0]->offset.x) + 100 * value(qx, l.points[1]->offset.x),
          k * value(py, l.points[0]->offset.y) + 100 * value(qy, l.points[1]->offset.y)};
}

// Without covers all pairs are there; with them those that meet inside the open sum may be missing.
TEST(ScalingWindow, every_pair_that_meets_is_a_candidate_or_meets_inside) {
  for (const auto& [grates, covers] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    const Region p = grates ? shapes::grate(4, 4, 1, 13) : on_integers(shapes::noisy_star(60, 0.6, 3), 4000);
    const Region q = grates ? shapes::comb(3, 3, 1, 5) : on_integers(shapes::noisy_star(40, 0.6, 4), 3000);
    auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
    planar::ScalingState state(base, {});
    const exact::BigRational low(1), high(3, 2);
    const planar::ReducedConvolution& convolution = state.windows.convolution_for(0.9, 1.6);
    planar::WindowSettings settings = state.windows.settings_for(low, high, 1);
    settings.mask = false;  // nothing is cut: every piece is a segment
    settings.cells = 24;
    settings.covers = covers;
    const planar::Window window(*base, convolution, settings);
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    const auto add = [&](std::uint32_t a, std::uint32_t b) { known.insert(std::minmax(a, b)); };
    for (const planar::Candidate& c : window.candidates) add(window.pieces[c.a].segment, window.pieces[c.b].segment);
    for (const auto& [a, b] : window.folds) add(a, b);
    for (const auto& [a, b] : window.touching) add(a, b);
    const auto n = static_cast<std::uint32_t>(window.segments.size());
    std::size_t meeting = 0, missed = 0, inside = 0;
    for (const int k : {100, 103, 111, 125, 140, 150}) {
      planar::ExactFrame position(base, planar::scale_value(exact::BigRational(k, 100)));
      const oracles::Membership<oracles::Big> sum(multiplied(p, k, k).data(), multiplied(q, 100, 100).data());
      // Two segments that meet do so in one point, unless they are parallel.
      const auto meet_inside = [&](const planar::LiveSegment& s, const planar::LiveSegment& t) {
        const auto a = corner(*base, s.start, k), b = corner(*base, s.end, k), c = corner(*base, t.start, k),
                   d = corner(*base, t.end, k);
        const oracles::Big ux = b.x - a.x, uy = b.y - a.y, vx = d.x - c.x, vy = d.y - c.y, cross = ux * vy - uy * vx;
        if (cross == 0) return false;
        const oracles::Big at = ((c.x - a.x) * vy - (c.y - a.y) * vx) / cross;
        return sum.overlaps({a.x + at * ux, a.y + at * uy});
      };
      for (std::uint32_t a = 0; a < n; ++a)
        for (std::uint32_t b = a + 1; b < n; ++b) {
          const planar::LiveSegment &s = window.segments[a], &t = window.segments[b];
          if (s.start == t.start || s.start == t.end || s.end == t.start || s.end == t.end) continue;
          if (planar::meet(window, a, b, position) == planar::Meet::none) continue;
          ++meeting;
          if (known.contains({a, b})) continue;
          // Every tenth is asked: the oracle is slow.
          if (covers && ++inside % 10 != 0) continue;
          missed += !covers || !meet_inside(s, t);
        }
    }
    EXPECT_GT(meeting, 300u);
    EXPECT_EQ(missed, 0u) << (grates ? "grates" : "stars") << (covers ? " with covers" : "");
    if (covers) {
      EXPECT_GT(inside, 50u);
    }
    // Most pairs never meet: something is rejected.
    EXPECT_LT(known.size(), std::size_t(n) * (n - 1) / 4);
  }
}

TEST(ScalingWindow, nodes_that_count_for_nothing_lie_inside_at_every_scale) {
  int inside = 0, others = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 engine(seed);
    const Region p = skylines(engine, 6, seed % 2 == 0), q = skylines(engine, 4, seed % 3 == 0);
    auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
    planar::ScalingState state(base, {});
    const exact::BigRational low(1), high(5, 4);
    EXPECT_EQ(std::ranges::count_if(state.windows.between(low, high)->nodes, &planar::PersistentNode::covered), 0);
    const auto window = state.windows.between(low, high, true);
    for (const int k : {101, 113, 125}) {
      const oracles::Membership<oracles::Big> sum(multiplied(p, k, k).data(), multiplied(q, 100, 100).data());
      for (const planar::PersistentNode& node : window->nodes) {
        if (node.covered) {
          EXPECT_TRUE(sum.overlaps(corner(*base, node.at, k))) << "seed " << seed << " at " << k;
        }
        ++(node.covered ? inside : others);
      }
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(others, 50);
}

TEST(ScalingWindow, windows_of_more_pairs_than_allowed_are_abandoned) {
  const Region p = on_integers(shapes::noisy_star(60, 0.6, 3), 4000),
               q = on_integers(shapes::noisy_star(40, 0.6, 4), 3000);
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  planar::ScalingState state(base, {});
  const planar::ReducedConvolution& convolution = state.windows.convolution_for(0.9, 1.6);
  planar::WindowSettings settings = state.windows.settings_for(exact::BigRational(1), exact::BigRational(3, 2), 1);
  const std::uint64_t pairs = planar::Window(*base, convolution, settings).pair_tests;
  settings.most_pairs = pairs;
  EXPECT_FALSE(planar::Window(*base, convolution, settings).abandoned);
  settings.most_pairs = pairs - 1;
  EXPECT_TRUE(planar::Window(*base, convolution, settings).abandoned);
}

// A window that would cost more than many frames from scratch is begun and abandoned; the frame is right all the same,
// and so are those after it, for which none is tried.
TEST(ScalingWindow, where_a_window_is_abandoned_the_frame_is_computed_from_scratch) {
  const Region p = on_integers(shapes::noisy_star(400, 0.9, 3), 1 << 20),
               q = on_integers(shapes::noisy_star(400, 0.9, 4), 1 << 20);
  ScalingSum sum = ScalingSum::create(p, q).value();
  for (const int k : {106, 112, 118}) {
    ASSERT_TRUE(sum.set(scale_of(k, 100)).ok());
    EXPECT_TRUE(sum.work().rebuilt) << k;
    EXPECT_FALSE(sum.work().new_window) << k;
    EXPECT_EQ(described(sum.sum(), exact::BigRational(100)), static_answer(p, q, k, 100, false, Semantics::closed))
        << k;
  }
}

// Beside small ones these cannot be a matter of the unit: products overflow, and doubles prove nothing.
TEST(ScalingWindow, huge_coordinates_beside_small_ones_equal_a_rebuild) {
  const double huge = 0x1p900;
  RegionData data;
  data.parts.push_back({{{0, 0}, {huge, 1}, {3, 2}, {huge, huge}, {-huge, 5}, {2, 1}}, {}});
  const Result<Region> p = Region::create(data);
  ASSERT_TRUE(p.ok());
  MovingOptions window, rebuild;
  window.mode = FrameMode::window;
  rebuild.mode = FrameMode::rebuild;
  ScalingSum sum = ScalingSum::create(*p, *p, window).value(), fresh = ScalingSum::create(*p, *p, rebuild).value();
  for (const int k : {101, 103, 106}) {
    ASSERT_TRUE(sum.set(scale_of(k, 100)).ok());
    ASSERT_TRUE(fresh.set(scale_of(k, 100)).ok());
    EXPECT_FALSE(sum.work().rebuilt);
    EXPECT_TRUE(sum.sum() == fresh.sum()) << k;
  }
}

TEST(ScalingWindow, lists_stay_as_they_are_within_their_intervals) {
  // Q is smaller and scales, so the window's parameter is the scale.
  const Region p = on_integers(shapes::noisy_star(40, 0.6, 3), 4000),
               q = on_integers(shapes::noisy_star(30, 0.6, 4), 3000);
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 1}).value();
  planar::ScalingState state(base, {});
  const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(6, 5)),
             other = state.windows.between(exact::BigRational(1), exact::BigRational(6, 5));
  ASSERT_EQ(window->frame().moving, 1u);
  const auto repaired = [&](planar::Window& of, double s) {
    auto lists = std::make_unique<planar::PieceLists>(of);
    planar::ExactFrame position(base, planar::scale_value(exact::exact_value(s)));
    FrameWork work;
    lists->repair(s, position, work);
    return lists;
  };
  const auto list = [](const planar::PieceLists& lists, std::uint32_t piece) {
    std::vector<std::uint32_t> entries;
    for (std::uint32_t k = 0; k < lists.count(piece); ++k) entries.push_back(lists.entry(piece, k));
    return entries;
  };
  std::size_t ends = 0, tight = 0;
  for (const double s : {1.03125, 1.109375, 1.171875}) {
    const auto lists = repaired(*window, s);
    for (std::uint32_t i = 0; i < window->pieces.size(); ++i) {
      const auto [low, high] = lists->proved(i);
      for (const double end : {low, high}) {
        if (!(end > window->frame().tau0 && end < window->frame().tau1)) continue;
        ++ends;
        const double inside = end + (s - end) * 0x1p-20, outside = end - (s - end) * 0x1p-10;
        EXPECT_EQ(list(*repaired(*other, inside), i), list(*lists, i))
            << "piece " << i << " from " << s << " to " << end;
        // Intervals are not much shorter than they could be: most end where the list changes.
        if (list(*repaired(*other, outside), i) != list(*lists, i)) ++tight;
      }
    }
  }
  EXPECT_GT(ends, 200u);
  EXPECT_GT(2 * tight, ends);
}

TEST(ScalingWindow, a_window_keeps_the_convolution_it_was_made_from) {
  // The tool fits one of the holes exactly at each of the scales below; ten times as large it fills all of them, and
  // the convolution is another one.
  RegionData data;
  data.parts.push_back({{{0, 0}, {80, 0}, {80, 10}, {0, 10}}, {}});
  for (int k = 33; k < 40; ++k) {
    const double x = 10 * (k - 33) + 3, size = k / 8.0;
    data.parts[0].holes.push_back({{x, 2}, {x, 2 + size}, {x + size, 2 + size}, {x + size, 2}});
  }
  const Region p = Region::create(data).value(), q = shapes::rectangle(0, 0, 4, 4);
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.25;
  auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 1}).value();
  planar::ScalingState state(base, options);
  ASSERT_TRUE(state.move_to(scale_of(1, 1), scale_of(1, 1)).ok());
  std::size_t degenerate = 0;
  for (int k = 33; k < 40; ++k) {
    // Looking for events far away requests the convolution of other scales.
    (void)state.windows.between(exact::BigRational(k % 2 == 0 ? 20 : 1, 2), exact::BigRational(k % 2 == 0 ? 21 : 2, 2));
    ASSERT_TRUE(state.move_to(scale_of(k, 32), scale_of(k, 32)).ok());
    degenerate += state.work.degenerate;
    EXPECT_EQ(described(state.sum, exact::BigRational(32)), static_answer(p, q, k, 32, true, Semantics::closed)) << k;
  }
  EXPECT_EQ(degenerate, 7u);
}

}  // namespace
}  // namespace dymsum
