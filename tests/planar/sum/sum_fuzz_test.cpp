// Random pairs on tiny grids against the sum by definition. DYMSUM_FUZZ_PAIRS sets how many (default 2000, under
// sanitizers 150), DYMSUM_FUZZ_SEED the first one; pair k of seed s is pair 0 of seed s + k, so that a failure replays
// alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/pair_text.h"
#include "oracles/sanitized.h"
#include "oracles/verdict.h"
#include "oracles/vertices_by.h"

namespace dymsum::oracles {
namespace {

const std::uint64_t kDefaultPairs = kSanitized ? 150 : 2000;

std::uint64_t pairs() { return setting("DYMSUM_FUZZ_PAIRS", kDefaultPairs); }

std::uint64_t first_seed(std::uint64_t fallback) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", fallback);
  std::printf("DYMSUM_FUZZ_SEED=%llu\n", static_cast<unsigned long long>(seed));
  return seed;
}

TEST(SumFuzz, tiny_grid_pairs_equal_the_sum_by_definition) {
  const std::uint64_t seed = first_seed(1), count = pairs();
  std::uint64_t tight = 0, holes = 0, thin = 0, k = 0;
  int failures = 0;
  for (; k < count && failures < 3; ++k) {
    Random random(seed + k);
    const auto [p, q] = random_pair(random, 2 + random.below(5));
    const std::string wrong = verdict(p, q);
    if (!wrong.empty()) {
      ++failures;
      ADD_FAILURE() << "DYMSUM_FUZZ_SEED=" << seed + k << " DYMSUM_FUZZ_PAIRS=1\n" << failure_report(p, q, wrong);
      continue;
    }
    const Result<PlanarSum> sum = minkowski_sum(*Region::create(p), *Region::create(q));
    tight += sum->tight_points.size() + sum->tight_segments.size();
    holes += sum->hole_count();
    thin += sum->segments.size() + sum->points.size();
  }
  std::printf("%llu pairs: %llu tight features, %llu holes, %llu thin pieces\n", static_cast<unsigned long long>(k),
              static_cast<unsigned long long>(tight), static_cast<unsigned long long>(holes),
              static_cast<unsigned long long>(thin));
  if (count < 1000) return;
  EXPECT_GT(tight, count / 20);
  EXPECT_GT(holes, count / 40);
  EXPECT_GT(thin, count / 100);
}

/// Tiny-grid coordinates plus noise of 2^-40: nearly degenerate, and in the widest fixed tier.
RegionData shaken(const RegionData& region, Random& random) {
  return oracles::vertices_by(region, [&](Point p) {
    return Point{p.x + random.signed_unit() * 0x1p-40, p.y + random.signed_unit() * 0x1p-40};
  });
}

TEST(SumFuzz, free_coordinates_equal_the_sum_by_definition) {
  const std::uint64_t seed = first_seed(1000000), count = std::min<std::uint64_t>(pairs() / 100, 300);
  std::uint64_t checked = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    Random random(seed + k);
    RegionData p, q;
    p.parts.push_back({random_polygon(random, 4, 3 + random.below(3)), {}});
    if (random.chance(70)) q.parts.push_back({random_polygon(random, 3, 3 + random.below(2)), {}});
    else q.polylines.push_back(random_polygon(random, 3, 3));
    p = shaken(p, random);
    q = shaken(q, random);
    const std::string wrong = verdict(p, q);
    if (refused(wrong)) continue;  // a flat corner crossed its neighbour
    ++checked;
    ASSERT_EQ(wrong, "") << "DYMSUM_FUZZ_SEED=" << seed + k << " DYMSUM_FUZZ_PAIRS=100\n" << to_text(p, q);
  }
  std::printf("%llu of %llu pairs valid\n", static_cast<unsigned long long>(checked),
              static_cast<unsigned long long>(count));
  EXPECT_GE(checked, count / 2);
}

TEST(SumFuzz, medium_shapes_pass_spot_checks_in_every_engine) {
  const std::uint64_t seed = first_seed(1);
  for (std::uint64_t k = 0; k < 6; ++k) {
    const Region p = shapes::random_polygon(24, 2, seed + k),
                 q = shapes::noisy_star(14 + static_cast<int>(k), 0.6, seed + k);
    Result<PlanarSum> sum = minkowski_sum(p, q);
    ASSERT_TRUE(sum.ok());
    ASSERT_EQ(spot_check_sum(p, q, *sum, 60, seed + k), "") << to_text(p.data(), q.data());
    for (const Engine engine : {Engine::brute, Engine::winding}) {
      SumOptions options;
      options.engine = engine;
      ASSERT_TRUE(*minkowski_sum(p, q, options) == *sum) << to_text(p.data(), q.data());
    }
  }
}

}  // namespace
}  // namespace dymsum::oracles
