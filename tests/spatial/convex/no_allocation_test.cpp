// Moving a warm sum, and the solid that follows, allocates nothing. Allocations are counted by counting_new.cpp.
#include <atomic>

#include "dymsum/convex_solid.h"
#include "oracles/sanitized.h"
#include "spatial/convex/convex_cases.h"

namespace dymsum::test {

extern std::atomic<std::size_t> allocations;
std::atomic<std::size_t> allocations{0};

namespace {

TEST(ConvexMotion, a_warm_sum_and_its_solid_move_without_allocating) {
  if (oracles::kSanitized) GTEST_SKIP() << "the sanitizer's operator new does not count";
  std::mt19937_64 random(41);
  ConvexSum moving = *ConvexSum::create(random_round_polytope(random, 120), random_round_polytope(random, 90));
  std::vector<SolidPose> poses;
  Rotation r;
  for (int k = 0; k < 100; ++k) {
    r = small_rotation(random, k % 10 == 0 ? 0.5 : 0.02) * r;
    poses.push_back({r, {}});
  }
  for (int round = 0; round < 3; ++round) {  // the second round begins with a jump that the first has not seen
    const std::size_t before = allocations;
    std::uint64_t changed = 0, facets = 0;
    for (const SolidPose& pose : poses) {
      changed += moving.set(pose).facets_added;
      facets += moving.solid().facet_count;
    }
    EXPECT_GT(changed, 100u);
    EXPECT_GT(facets, 100u);
    if (round == 2) {
      EXPECT_EQ(allocations - before, 0u);
    }
    if (round == 0) {
      EXPECT_GT(allocations - before, 0u) << "the counter counts";
    }
  }
}

}  // namespace
}  // namespace dymsum::test
