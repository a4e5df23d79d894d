#include "base/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/scratch.h"

namespace dymsum::base {
namespace {

TEST(MemoryBudget, WhatIsTooMuchIsNotHeldAndSaysHowMuchItWouldBe) {
  MemoryBudget budget(100);
  budget.take(60);
  try {
    budget.take(41);
    FAIL() << "101 bytes within 100";
  } catch (const OverMemory& over) {
    EXPECT_EQ(over.bytes(), 101u);
    EXPECT_EQ(over.limit(), 100u);
  }
  EXPECT_EQ(budget.held(), 60u);
  budget.take(40);
  budget.give(100);
  EXPECT_EQ(budget.held(), 0u);
}

TEST(MemoryBudget, WhatIsHeldCountsWithTheLargerComputationToo) {
  const auto larger = std::make_shared<MemoryBudget>(100);
  const auto smaller = std::make_shared<MemoryBudget>(80, larger);
  larger->take(50);
  smaller->take(40);
  EXPECT_EQ(larger->held(), 90u);
  EXPECT_THROW(smaller->take(20), OverMemory) << "the larger limit";
  EXPECT_EQ(smaller->held(), 40u);
  EXPECT_EQ(larger->held(), 90u);
  smaller->give(40);
  EXPECT_EQ(larger->held(), 50u);
}

TEST(MemoryBudget, ArraysCountBeforeTheyAreMadeAndGiveBack) {
  const auto budget = std::make_shared<MemoryBudget>(10000);
  CountedArray<int> free_of_it(10);
  {
    const UseBudget use(budget);
    CountedArray<int> a(1000);
    EXPECT_EQ(budget->held(), 4000u);
    EXPECT_EQ(a[999], 0) << "values, as of any vector";
    CountedArray<int> copy = a;
    EXPECT_EQ(budget->held(), 8000u);
    CountedArray<int> moved = std::move(copy);
    EXPECT_EQ(budget->held(), 8000u);
    EXPECT_THROW(a.reserve(2000), OverMemory);
    EXPECT_EQ(a.size(), 1000u);
    EXPECT_EQ(budget->held(), 8000u);
    moved = {};
    moved.shrink_to_fit();
    free_of_it = CountedArray<int>(500);
  }
  EXPECT_EQ(budget->held(), 2000u) << "what was moved out still counts";
  free_of_it = CountedArray<int>();
  EXPECT_EQ(budget->held(), 0u);
  EXPECT_EQ(current_budget(), nullptr);
}

TEST(MemoryBudget, BlocksOfAScratchCount) {
  const auto budget = std::make_shared<MemoryBudget>(std::size_t{1} << 20);
  const UseBudget use(budget);
  Scratch scratch;
  {
    Array<double> small(16, &scratch);
    const auto at = reinterpret_cast<std::uintptr_t>(small.data());
    const auto buffer = reinterpret_cast<std::uintptr_t>(&scratch);
    const bool in_buffer = at >= buffer && at < buffer + sizeof scratch;  // never with the address sanitizer
    EXPECT_EQ(budget->held(), in_buffer ? 0u : 128u) << (in_buffer ? "on the stack" : "a block of its own");
    Array<double> large(10000, &scratch);
    EXPECT_GE(budget->held(), 80000u);
    EXPECT_LE(budget->held(), 120000u);
    EXPECT_THROW(Array<double>(200000, &scratch), OverMemory);
  }
  EXPECT_EQ(budget->held(), 0u);
}

TEST(MemoryBudget, ThreadsOfALoopShareIt) {
  const auto budget = std::make_shared<MemoryBudget>(1000000);
  const UseBudget use(budget);
  std::atomic<int> counted{0};
  parallel_parts(64, 0, [&](std::size_t) {
    const CountedArray<char> bytes(1000);
    counted += budget->held() >= 1000;
  });
  EXPECT_EQ(counted, 64);
  EXPECT_EQ(budget->held(), 0u);
  EXPECT_THROW(parallel_parts(4, 0, [&](std::size_t) { const CountedArray<char> bytes(2000000); }), OverMemory);
}

TEST(MemoryBudget, AnErrorNamesWhatItIsForAndBothNumbers) {
  const auto taking = [](std::size_t bytes) {
    return within_memory(5000000, "the sum", [&]() -> Result<std::size_t> { return CountedArray<char>(bytes).size(); });
  };
  EXPECT_EQ(*taking(5000000), 5000000u);
  const Result<std::size_t> refused = taking(12000000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_memory);
  EXPECT_EQ(refused.error().message, "the sum takes at least 12 MB of memory, the limit is 5 MB");
  EXPECT_EQ(*within_memory(0, "the sum", [] { return Result<int>(1); }), 1) << "no limit";
}

}  // namespace
}  // namespace dymsum::base
