// The scaling sum against the static engine on integers, which shares none of its windows, lists or scaled lattices.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dymsum
