// One block for many arrays: what does not fit, copies and moves.
#include "base/memory_budget.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>

namespace dymsum {
namespace {

struct Lists {
  OwnMemory memory;
  OwnArray<std::uint32_t> numbers{memory};
  OwnArray<double> values{memory};
};

Lists counted(std::size_t bytes, std::size_t n) {
  Lists lists{OwnMemory(bytes)};
  lists.numbers.resize(n);
  std::iota(lists.numbers.begin(), lists.numbers.end(), 0u);
  lists.values.assign(n, 0.5);
  return lists;
}

TEST(OwnMemory, HoldsWhatFitsAndLeavesTheRestToTheHeap) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{16}, std::size_t{400}, std::size_t{4000}}) {
    Lists lists = counted(bytes, 50);
    for (std::uint32_t k = 50; k < 5000; ++k) lists.numbers.push_back(k);  // grows out of every block
    for (std::uint32_t k = 0; k < 5000; ++k) ASSERT_EQ(lists.numbers[k], k);
    for (const double v : lists.values) ASSERT_EQ(v, 0.5);
  }
}

TEST(OwnMemory, ArraysLieSideBySide) {
  const Lists lists = counted(1000, 8);
  EXPECT_EQ(reinterpret_cast<const std::byte*>(lists.values.data()) -
                reinterpret_cast<const std::byte*>(lists.numbers.data()),
            32);
}

TEST(OwnMemory, CopiesStandOnTheirOwn) {
  Lists copy, assigned;
  {
    const Lists lists = counted(4000, 50);
    copy = Lists(lists);
    assigned = lists;
  }
  for (const Lists* lists : {&copy, &assigned}) {
    ASSERT_EQ(lists->numbers.size(), 50u);
    for (std::uint32_t k = 0; k < 50; ++k) ASSERT_EQ(lists->numbers[k], k);
    ASSERT_EQ(lists->values, (OwnArray<double>(50, 0.5)));
  }
}

TEST(OwnMemory, MovesWithItsArrays) {
  Lists lists = counted(4000, 50);
  const Lists moved = std::move(lists);
  ASSERT_EQ(moved.numbers.size(), 50u);
  for (std::uint32_t k = 0; k < 50; ++k) ASSERT_EQ(moved.numbers[k], k);
}

}  // namespace
}  // namespace dymsum
