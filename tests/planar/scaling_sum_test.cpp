// The scaling sum against the static engine on integers, which shares none of its windows, lists or scaled lattices.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/scaling_same.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

std::vector<std::string> ours(const ScalingSum& sum, long b) { return described(sum.sum(), exact::BigRational(b)); }

struct Mode {
  const char* name;
  ScalingMode mode;
  double window;
};
constexpr Mode kModes[] = {{"rebuild", ScalingMode::rebuild, 0}, {"window 40 %", ScalingMode::window, 0.4}, {"automatic", ScalingMode::automatic, 0}};

TEST(ScalingSum, tiny_pairs_equal_the_static_engine_at_every_step) {
  const char* pairs = std::getenv("DYMSUM_FUZZ_PAIRS");
  const int rounds = pairs != nullptr ? std::atoi(pairs) / 40 : 250;
  std::uint64_t degenerate = 0, windows = 0, kept = 0;
  for (int round = 0; round < rounds; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const oracles::Pair pair = oracles::random_pair(random, 6);
    const Region p = Region::create(pair.p).value(), q = Region::create(pair.q).value();
    const bool q_scales = random.chance(40);
    const Mode& mode = kModes[random.below(3)];
    ScalingOptions options;
    options.scaled = q_scales ? ScaledOperand::q : ScaledOperand::p;
    options.mode = mode.mode;
    options.window = mode.window;
    options.semantics = random.chance(20) ? Semantics::open : random.chance(20) ? Semantics::regular : Semantics::closed;
    options.min_tier_bits = random.chance(30) ? 61 : 0;
    ScalingSum sum = ScalingSum::create(p, q, options).value();
    long a = 12, b = 12;
    for (int step = 0; step < 12; ++step) {
      ASSERT_TRUE(sum.set(scale_of(a, b)).ok());
      ASSERT_EQ(ours(sum, b), static_answer(p, q, double(a), double(b), q_scales, options.semantics))
          << "round " << round << ", " << mode.name << ", s = " << a << "/" << b << ", Q scales: " << q_scales;
      degenerate += sum.work().degenerate;
      windows += sum.work().new_window;
      kept += sum.work().loops_kept;
      // Small steps on a grid of simple fractions: most of them are events.
      a = std::max(3L, a + random.below(5) - 2);
      if (random.chance(10)) b = 6 + random.below(12);
    }
  }
  EXPECT_GT(degenerate, 0u);
  EXPECT_GT(windows, 0u);
  EXPECT_GT(kept, 0u);
}

/// Coordinates rounded to integers below 2^bits.
Region on_integers(const Region& region, double size) {
  const auto box = bounds(region);
  const double f = size / std::max(box[2] - box[0], box[3] - box[1]);
  RegionData data = region.data();
  const auto all = [&](std::vector<Point>& list) {
    for (Point& p : list) p = {std::round((p.x - box[0]) * f), std::round((p.y - box[1]) * f)};
  };
  for (Part& part : data.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  return Region::create(std::move(data)).value();
}

struct Shape {
  const char* name;
  Region p, q;
};

std::vector<Shape> shapes_of_some_size() {
  std::vector<Shape> list;
  list.push_back({"star 60 and star 50", on_integers(shapes::noisy_star(60, 0.5, 1), 20000), on_integers(shapes::noisy_star(50, 0.7, 2), 9000)});
  list.push_back({"random with holes and star", on_integers(shapes::random_polygon(120, 5, 3), 30000), on_integers(shapes::noisy_star(24, 0.6, 4), 4000)});
  list.push_back({"pockets and disc", on_integers(shapes::pockets(12, 10), 20000), on_integers(shapes::disc(16, 1), 900)});
  list.push_back({"spiral and gear", on_integers(shapes::spiral(3, 24, 1, 0.4), 20000), on_integers(shapes::gear(9, 1, 1.3), 2500)});
  list.push_back({"grate and comb", on_integers(shapes::grate(6, 4, 1, 20), 120), on_integers(shapes::comb(7, 2, 1, 5), 26)});
  return list;
}

TEST(ScalingSum, larger_pairs_with_masks_equal_the_static_engine) {
  for (const Shape& shape : shapes_of_some_size())
    for (const bool q_scales : {false, true})
      for (const double width : {0.03, 0.3}) {
        ScalingOptions options;
        options.scaled = q_scales ? ScaledOperand::q : ScaledOperand::p;
        options.mode = ScalingMode::window;
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

}  // namespace
}  // namespace dymsum
