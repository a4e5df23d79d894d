// The scaling sum against the static engine on integers, which shares none of its windows, lists or scaled lattices.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/scaling_same.h"
#include "planar/position/exact_source.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

std::vector<std::string> ours(const ScalingSum& sum, long b) { return described(sum.sum(), exact::BigRational(b)); }

struct Mode {
  const char* name;
  FrameMode mode;
  double window;
};
constexpr Mode kModes[] = {{"rebuild", FrameMode::rebuild, 0},
                           {"window 40 %", FrameMode::window, 0.4},
                           {"automatic", FrameMode::automatic, 0}};

TEST(ScalingSum, tiny_pairs_equal_the_static_engine_at_every_step) {
  const char* pairs = std::getenv("DYMSUM_FUZZ_PAIRS");
  const int rounds = pairs != nullptr ? std::atoi(pairs) / 40 : 250;
  std::uint64_t degenerate = 0, windows = 0, kept = 0, lost = 0;
  for (int round = 0; round < rounds; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const oracles::Pair pair = oracles::random_pair(random, 6);
    const Region p = Region::create(pair.p).value(), q = Region::create(pair.q).value();
    const bool q_scales = random.chance(40);
    const Mode& mode = kModes[random.below(3)];
    MovingOptions options;
    options.moving = q_scales ? MovingOperand::q : MovingOperand::p;
    options.mode = mode.mode;
    options.window = mode.window;
    options.semantics = random.chance(20)   ? Semantics::open
                        : random.chance(20) ? Semantics::regular
                                            : Semantics::closed;
    planar::SumInternals::min_tier_bits(options) = random.chance(30) ? 61 : 0;
    ScalingSum sum = ScalingSum::create(p, q, options).value();
    long a = 12, b = 12;
    for (int step = 0; step < 12; ++step) {
      ASSERT_TRUE(sum.set(scale_of(a, b)).ok());
      ASSERT_EQ(ours(sum, b), static_answer(p, q, double(a), double(b), q_scales, options.semantics))
          << "round " << round << ", " << mode.name << ", s = " << a << "/" << b << ", Q scales: " << q_scales;
      degenerate += sum.work().degenerate;
      windows += sum.work().new_window;
      kept += sum.work().loops_kept;
      lost += sum.work().witnesses_lost;
      // Small steps on a grid of simple fractions: most of them are events.
      a = std::max(3L, a + random.below(5) - 2);
      if (random.chance(10)) b = 6 + random.below(12);
    }
  }
  EXPECT_GT(degenerate, 0u);
  EXPECT_GT(windows, 0u);
  EXPECT_GT(kept, 0u);
  // Collisions remembered for touches are looked at again, and found gone.
  EXPECT_GT(lost, 0u);
}

struct ScaledPair {
  const char* name;
  Region p, q;
};

std::vector<ScaledPair> scaled_pairs() {
  std::vector<ScaledPair> list;
  list.push_back({"star 60 and star 50", on_integers(shapes::noisy_star(60, 0.5, 1), 20000),
                  on_integers(shapes::noisy_star(50, 0.7, 2), 9000)});
  list.push_back({"random with holes and star", on_integers(shapes::random_polygon(120, 5, 3), 30000),
                  on_integers(shapes::noisy_star(24, 0.6, 4), 4000)});
  list.push_back({"pockets and disc", on_integers(snapped_shapes::pockets(12, 10), 20000),
                  on_integers(snapped_shapes::disc(16, 1), 900)});
  list.push_back({"spiral and gear", on_integers(snapped_shapes::spiral(3, 24, 1, 0.4), 20000),
                  on_integers(snapped_shapes::gear(9, 1, 1.3), 2500)});
  list.push_back(
      {"grate and comb", on_integers(shapes::grate(6, 4, 1, 20), 120), on_integers(shapes::comb(7, 2, 1, 5), 26)});
  return list;
}

TEST(ScalingSum, larger_pairs_with_masks_equal_the_static_engine) {
  for (const ScaledPair& shape : scaled_pairs())
    for (const bool q_scales : {false, true})
      for (const double width : {0.03, 0.3}) {
        MovingOptions options;
        options.moving = q_scales ? MovingOperand::q : MovingOperand::p;
        options.mode = FrameMode::window;
        options.window = width;
        ScalingSum sum = ScalingSum::create(shape.p, shape.q, options).value();
        oracles::Random random(7);
        long a = 100;
        std::uint64_t fast = 0;
        for (int step = 0; step < 40; ++step) {
          a = std::max(20L, a + random.below(9) - 4);
          ASSERT_TRUE(sum.set(scale_of(a, 100)).ok());
          fast += !sum.work().new_window;
          ASSERT_EQ(ours(sum, 100), static_answer(shape.p, shape.q, double(a), 100, q_scales, options.semantics))
              << shape.name << ", s = " << a << "/100, Q scales: " << q_scales << ", width " << width;
        }
        EXPECT_GT(fast, 5u) << shape.name;
      }
}

ScaledPair middling() {
  return {"random with holes and star", on_integers(shapes::random_polygon(60, 3, 5), 3000),
          on_integers(shapes::noisy_star(16, 0.6, 4), 500)};
}

TEST(ScalingSum, forward_and_back_returns_the_identical_state) {
  const ScaledPair shape = middling();
  ScalingSum sum = ScalingSum::create(shape.p, shape.q).value();
  std::vector<std::vector<std::string>> seen;
  std::vector<std::uint64_t> hashes;
  for (int k = 0; k < 40; ++k) {
    ASSERT_TRUE(sum.set(1 + k / 64.0).ok());
    seen.push_back(described(sum.sum(), exact::BigRational(1)));
    hashes.push_back(sum.combinatorial_hash());
  }
  for (int k = 39; k >= 0; --k) {
    ASSERT_TRUE(sum.set(1 + k / 64.0).ok());
    EXPECT_EQ(described(sum.sum(), exact::BigRational(1)), seen[static_cast<std::size_t>(k)]) << k;
    EXPECT_EQ(sum.combinatorial_hash(), hashes[static_cast<std::size_t>(k)]) << k;
  }
}

TEST(ScalingSum, non_uniform_scales_equal_the_static_engine) {
  const ScaledPair shape = middling();
  for (const bool q_scales : {false, true}) {
    MovingOptions options;
    options.moving = q_scales ? MovingOperand::q : MovingOperand::p;
    ScalingSum sum = ScalingSum::create(shape.p, shape.q, options).value();
    oracles::Random random(3);
    for (int k = 0; k < 20; ++k) {
      const long a = 50 + random.below(100), b = 50 + random.below(100);
      ASSERT_TRUE(sum.set(scale_of(a, 100), scale_of(b, 100)).ok());
      const Region p = multiplied(shape.p, q_scales ? 100.0 : double(a), q_scales ? 100.0 : double(b));
      const Region q = multiplied(shape.q, q_scales ? double(a) : 100.0, q_scales ? double(b) : 100.0);
      EXPECT_EQ(ours(sum, 100), described(minkowski_sum(p, q).value(), exact::BigRational(1)));
      ASSERT_TRUE(sum.set(scale_of(a, 100)).ok());
      EXPECT_EQ(ours(sum, 100), static_answer(shape.p, shape.q, double(a), 100, q_scales, Semantics::closed));
    }
  }
}

TEST(ScalingSum, a_frame_without_event_touches_no_loop) {
  const ScaledPair shape = middling();
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.1;
  ScalingSum sum = ScalingSum::create(shape.p, shape.q, options).value();
  ASSERT_TRUE(sum.set(1.015625).ok());
  // Two neighbouring scales between which nothing happens, inside the sum neither.
  const double low = 1.03, high = low + 4e-6;
  ASSERT_TRUE(sum.set(low + 0.25 * (high - low)).ok());
  const auto changes = sum.set(low + 0.75 * (high - low)).value();
  EXPECT_FALSE(sum.work().new_window);
  EXPECT_FALSE(sum.work().rebuilt);
  EXPECT_EQ(sum.work().lists_changed, 0u);
  EXPECT_EQ(sum.work().loops_traced, 0u);
  EXPECT_EQ(sum.work().collision_tests, 0u);
  EXPECT_EQ(sum.work().exact_signs, 0u);
  EXPECT_FALSE(changes.topology);
  for (const RingChange& c : changes.rings) EXPECT_EQ(c.kind, RingChange::Kind::moved);
  EXPECT_EQ(changes.rings.size(), sum.ring_ids().size());
  // The same scale again: not even that.
  EXPECT_TRUE(sum.set(low + 0.75 * (high - low)).value().rings.empty());
}

TEST(ScalingSum, identities_and_changes_account_for_every_ring) {
  const ScaledPair shape = middling();
  ScalingSum sum = ScalingSum::create(shape.p, shape.q).value();
  std::vector<std::uint64_t> alive = sum.ring_ids();
  std::vector<std::uint64_t> ended;
  for (int k = 0; k < 200; ++k) {
    const FrameChanges changes = sum.set(0.5 + k / 128.0).value();
    std::vector<std::uint64_t> next = alive;
    for (const RingChange& c : changes.rings) {
      if (c.kind == RingChange::Kind::appeared) {
        EXPECT_EQ(std::count(ended.begin(), ended.end(), c.ring), 0) << "an identity used again";
        next.push_back(c.ring);
      } else {
        const auto it = std::find(next.begin(), next.end(), c.ring);
        ASSERT_NE(it, next.end());
        if (c.kind == RingChange::Kind::disappeared) {
          ended.push_back(c.ring);
          next.erase(it);
        }
      }
    }
    std::vector<std::uint64_t> now = sum.ring_ids();
    std::sort(now.begin(), now.end());
    std::sort(next.begin(), next.end());
    EXPECT_EQ(now, next) << k;
    EXPECT_EQ(now.size(), sum.sum().parts.size() + sum.sum().hole_count());
    alive = now;
  }
  EXPECT_FALSE(ended.empty());
}

// P + s P: all edges have parallels, and at reflex vertices ends of segments lie on other segments at every scale.
TEST(ScalingSum, parallel_operands_are_updated_without_the_vertex_routine) {
  const Region p = on_integers(shapes::random_polygon(60, 2, 8), 4000);
  MovingOptions options;
  options.mode = FrameMode::window;
  options.window = 0.2;
  ScalingSum sum = ScalingSum::create(p, p, options).value();
  int updated = 0;
  for (int k = 65; k < 128; ++k) {
    ASSERT_TRUE(sum.set(scale_of(k, 64)).ok());
    ASSERT_EQ(ours(sum, 64), static_answer(p, p, k, 64, false, Semantics::closed)) << k << "/64";
    updated += !sum.work().degenerate && !sum.work().rebuilt;
  }
  EXPECT_GT(updated, 50);
}

TEST(ScalingSum, many_random_steps_equal_a_rebuild) {
  const bool heavy = std::getenv("DYMSUM_FUZZ_PAIRS") != nullptr;
  const ScaledPair shape = middling();
  ScalingSum sum = ScalingSum::create(shape.p, shape.q).value();
  oracles::Random random(11);
  long a = 4096;
  for (int step = 0; step < (heavy ? 100000 : 2000); ++step) {
    a = std::clamp(a + random.below(33) - 16 + (random.chance(1) ? random.below(4000) - 2000 : 0), 400L, 40000L);
    ASSERT_TRUE(sum.set(scale_of(a, 4096)).ok());
    if (step % (heavy ? 100 : 20) != 0) continue;
    ASSERT_EQ(ours(sum, 4096), static_answer(shape.p, shape.q, double(a), 4096, false, Semantics::closed))
        << "step " << step << ", s = " << a << "/4096";
  }
}

// Costs are counted: what else the machine does cannot change how frames are made.
TEST(ScalingSum, every_run_makes_the_same_choices) {
  const ScaledPair shape = middling();
  const auto run = [&] {
    ScalingSum sum = ScalingSum::create(shape.p, shape.q).value();
    std::vector<std::array<double, 4>> choices;
    double s = 1;
    for (int k = 0; k < 120; ++k) {
      s = k % 40 == 39 ? 1 : std::round(s * (k < 40 ? 1.002 : k < 80 ? 1.01 : 1.2) * 0x1p14) * 0x1p-14;
      EXPECT_TRUE(sum.set(s).ok());
      const FrameWork& work = sum.work();
      choices.push_back({work.new_window ? 1.0 : 0.0, work.rebuilt ? 1.0 : 0.0, work.window_low, work.window_high});
    }
    return choices;
  };
  const auto choices = run();
  EXPECT_EQ(choices, run());
  double windows = 0, rebuilt = 0;
  for (const auto& c : choices) {
    windows += c[0];
    rebuilt += c[1];
  }
  EXPECT_GE(windows, 2);
  EXPECT_GT(rebuilt, 10);
}

TEST(ScalingSum, bad_scales_are_refused_and_change_nothing) {
  const ScaledPair shape = middling();
  ScalingSum sum = ScalingSum::create(shape.p, shape.q).value();
  ASSERT_TRUE(sum.set(1.25).ok());
  const auto before = described(sum.sum(), exact::BigRational(1));
  EXPECT_EQ(sum.set(0.0).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.set(-1.0).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.set(NAN).error().code, ErrorCode::not_finite);
  EXPECT_EQ(sum.set(INFINITY).error().code, ErrorCode::not_finite);
  EXPECT_EQ(sum.set(0x1p-65).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.set(0x1p65).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.set(0x1p-1074).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.set(5e-324).error().message, "a scale has to lie between 2^-64 and 2^64: 5e-324");
  EXPECT_EQ(sum.set(1e308).error().message, "a scale has to lie between 2^-64 and 2^64: 1e+308");
  EXPECT_EQ(Scale::of(Rational()).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(Scale::parse("1/0").error().code, ErrorCode::bad_scale);
  EXPECT_EQ(Scale::parse("x/2").error().code, ErrorCode::malformed);
  EXPECT_EQ(*Scale::parse("010/08"), scale_of(5, 4)) << "decimal, whatever the leading zeros";
  EXPECT_EQ(Scale::of(*Rational::parse("1/" + std::string(2000, '7'))).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(Scale::parse("1/").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("1.2.3").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("1e999999999").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("nan").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("-2").error().code, ErrorCode::bad_scale);
  EXPECT_EQ(parse_scale_step("1.01").value(), Scale::parse("1.01").value());
  EXPECT_EQ(parse_scale_step("0").error().message, "a step of zero leads nowhere");
  // At once: making them would take minutes, and all memory.
  for (const StepKind kind : {StepKind::difference, StepKind::percent})
    EXPECT_EQ(scale_steps(scale_of(1, 1), scale_of(2, 1), *Scale::of(0x1p-39), kind, 1000000000).error().message,
              "more than 1000000000 steps");
  EXPECT_EQ(parse_scale_step("-1").error().code, ErrorCode::bad_scale);
  EXPECT_EQ(parse_scale_step("1e30").error().code, ErrorCode::bad_scale);
  EXPECT_EQ(parse_scale_step("1/0").error().code, ErrorCode::bad_scale);
  EXPECT_EQ(parse_scale_step("x").error().code, ErrorCode::malformed);
  EXPECT_EQ(parse_scale_step("1/x").error().code, ErrorCode::malformed);
  EXPECT_EQ(Scale::parse("1.01").value().exact().to_string(), "101/100");
  EXPECT_EQ(Scale::parse("25e-1").value().exact().to_string(), "5/2");
  EXPECT_EQ(sum.scale(), Scale::of(1.25).value());
  EXPECT_EQ(described(sum.sum(), exact::BigRational(1)), before);
  for (const double s : {0x1p-64, 0x1p64, 1e-9, 1e9}) EXPECT_TRUE(sum.set(s).ok()) << s;
}

TEST(ScalingSum, a_cancelled_frame_changes_nothing) {
  const ScaledPair shape = middling();
  MovingOptions options;
  bool stop = false;
  options.progress = [&](std::string_view, double) { return !stop; };
  ScalingSum sum = ScalingSum::create(shape.p, shape.q, options).value();
  const auto before = described(sum.sum(), exact::BigRational(1));
  stop = true;
  EXPECT_EQ(sum.set(3.0).error().code, ErrorCode::cancelled);
  EXPECT_EQ(described(sum.sum(), exact::BigRational(1)), before);
  stop = false;
  ASSERT_TRUE(sum.set(3.0).ok());
  EXPECT_EQ(ours(sum, 1), static_answer(shape.p, shape.q, 3, 1, false, Semantics::closed));
}

TEST(ScalingSum, copies_of_a_master_shape_equal_their_own_sums) {
  const ScaledPair shape = middling();
  std::vector<ScaledCopy> copies;
  oracles::Random random(5);
  for (int k = 0; k < 12; ++k)
    copies.push_back({scale_of(40 + random.below(160), 100), {double(100 * k), double(50 * k)}});
  const std::vector<CopySum> sums = scaled_copies(shape.p, shape.q, copies).value();
  ASSERT_EQ(sums.size(), copies.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const long a = std::lround(copies[k].scale.approx() * 100);
    EXPECT_EQ(described(sums[k].sum, exact::BigRational(100)),
              static_answer(shape.p, shape.q, double(a), 100, false, Semantics::closed));
    EXPECT_EQ(sums[k].at, copies[k].at);
  }
}

TEST(ScalingSum, copies_of_equal_scale_share_one_frame) {
  const ScaledPair shape = middling();
  std::vector<ScaledCopy> copies;
  for (int k = 0; k < 12; ++k) copies.push_back({scale_of(2 + k % 4, 3), {double(k), 0}});
  MovingOptions options;
  options.mode = FrameMode::rebuild;
  const std::vector<CopySum> sums = scaled_copies(shape.p, shape.q, copies, options).value();
  int frames = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    frames += sums[k].work.rebuilt;
    EXPECT_EQ(sums[k].work.rebuilt, k < 4);
    EXPECT_EQ(described(sums[k].sum, exact::BigRational(3)),
              static_answer(shape.p, shape.q, double(2 + k % 4), 3, false, Semantics::closed));
  }
  EXPECT_EQ(frames, 4);
  const auto stop = [](std::string_view stage, double) { return stage != "copies"; };
  options.progress = stop;
  EXPECT_EQ(scaled_copies(shape.p, shape.q, copies, options).error().code, ErrorCode::cancelled);
}

TEST(ScalingSum, copies_of_close_scales_share_a_window) {
  const ScaledPair shape = middling();
  std::vector<ScaledCopy> copies;
  for (int k = 0; k < 12; ++k) copies.push_back({scale_of(100 + 5 * k % 12, 100), {}});  // within 11 %
  for (const long a : {300, 60}) copies.push_back({scale_of(a, 100), {}});
  const std::vector<CopySum> sums = scaled_copies(shape.p, shape.q, copies).value();
  int windows = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    windows += sums[k].work.new_window;
    EXPECT_EQ(sums[k].work.rebuilt, k >= 12) << k;
    const long a = std::lround(copies[k].scale.approx() * 100);
    EXPECT_EQ(described(sums[k].sum, exact::BigRational(100)),
              static_answer(shape.p, shape.q, double(a), 100, false, Semantics::closed))
        << k;
  }
  EXPECT_EQ(windows, 1);
  EXPECT_TRUE(scaled_copies(shape.p, shape.q, {}).value().empty());
}

TEST(ScalingSum, a_robot_is_reflected) {
  const ScaledPair shape = middling();
  for (const bool q_scales : {false, true}) {
    MovingOptions options;
    options.reflect_q = true;
    options.moving = q_scales ? MovingOperand::q : MovingOperand::p;
    ScalingSum sum = ScalingSum::create(shape.p, shape.q, options).value();
    for (long a = 100; a < 110; ++a) {
      ASSERT_TRUE(sum.set(scale_of(a, 100)).ok());
      ASSERT_EQ(ours(sum, 100), static_answer(shape.p, negated(shape.q), double(a), 100, q_scales, Semantics::closed))
          << a;
    }
  }
}

}  // namespace
}  // namespace dymsum
