#include "base/parallel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <random>

#include "base/memory_budget.h"

namespace dymsum::base {
namespace {

// Few values and many, all different, nearly all equal, in order and in the opposite order.
TEST(ParallelSort, sorts_as_one_thread_does) {
  constexpr std::uint32_t kSeed = 3;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  for (const std::size_t n : {0, 1, 2, 4095, 4096, 4097, 4099, 50'001}) {
    for (const std::uint32_t range : {1u, 3u, 1000u, 4'000'000'000u}) {
      std::vector<std::uint32_t> values(n);
      for (std::uint32_t& v : values) v = random() % range;
      std::vector<std::uint32_t> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (const int threads : {1, 2, 0}) {
        std::vector<std::uint32_t> ours = values;
        parallel_sort(ours, threads, std::less<>());
        EXPECT_EQ(ours, sorted) << n << " values below " << range << ", threads " << threads;
        parallel_sort(ours, threads, std::greater<>());
        EXPECT_TRUE(std::equal(ours.begin(), ours.end(), sorted.rbegin()));
      }
    }
  }
}

TEST(FreeMemory, gives_memory_back) {
  std::vector<int> a(1000), b(10);
  free_memory(a, b);
  EXPECT_EQ(a.capacity() + b.capacity(), 0u);
}

}  // namespace
}  // namespace dymsum::base
