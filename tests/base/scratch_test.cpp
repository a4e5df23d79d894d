#include "base/scratch.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>

namespace dymsum {
namespace {

// Blocks of all sizes in random order of life: none overlaps another, all are aligned, and none loses what was written
// into it.
TEST(Scratch, BlocksAreDisjointAlignedAndKeepTheirContents) {
  constexpr std::uint32_t kSeed = 7;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  for (int round = 0; round < 20; ++round) {
    Scratch scratch;
    struct Block {
      std::size_t size;
      unsigned char fill;
    };
    std::map<unsigned char*, Block> blocks;
    const auto check = [](unsigned char* at, const Block& b) {
      for (std::size_t i = 0; i < b.size; ++i) {
        ASSERT_EQ(at[i], b.fill);
      }
    };
    for (int step = 0; step < 400; ++step) {
      if (blocks.empty() || random() % 3 != 0) {
        const std::size_t size = 1 + random() % (std::size_t{1} << (random() % 20));
        auto* at = static_cast<unsigned char*>(scratch.take(size));
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(at) % alignof(std::max_align_t), 0u);
        const auto after = blocks.lower_bound(at);
        if (after != blocks.end()) {
          ASSERT_LE(at + size, after->first);
        }
        if (after != blocks.begin()) {
          const auto before = std::prev(after);
          ASSERT_LE(before->first + before->second.size, at);
        }
        const Block block{size, static_cast<unsigned char>(step)};
        std::memset(at, block.fill, size);
        blocks.emplace(at, block);
      } else {
        const auto it = std::next(blocks.begin(), static_cast<std::ptrdiff_t>(random() % blocks.size()));
        check(it->first, it->second);
        scratch.give(it->first, it->second.size);
        blocks.erase(it);
      }
    }
    for (const auto& [at, block] : blocks) {
      check(at, block);
      scratch.give(at, block.size);
    }
  }
}

TEST(Scratch, TellsTheMostBytesHandedOutAtOneTime) {
  Scratch scratch;
  void* const small = scratch.take(1000);
  void* const large = scratch.take(100000);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
  scratch.give(large, 100000);
  void* const other = scratch.take(5000);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
  scratch.give(other, 5000);
  scratch.give(small, 1000);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
}

// Arrays with a scratch take their memory there, copies of them on the heap; numbers that resize() adds need no value.
TEST(Scratch, ArraysLieInIt) {
  Scratch scratch;
  Array<std::uint32_t> numbers(&scratch);
  numbers.reserve(10);
  EXPECT_EQ(scratch.peak_bytes(), 40u);
  numbers.resize(10);
  for (std::uint32_t k = 0; k < 10; ++k) numbers[k] = k;
  const Array<std::uint32_t> copy(numbers);
  EXPECT_EQ(copy, numbers);
  EXPECT_EQ(copy.get_allocator().scratch(), nullptr);
  numbers.resize(20, 7);
  EXPECT_EQ(numbers[9], 9u);
  EXPECT_EQ(numbers[19], 7u);
  EXPECT_GT(scratch.peak_bytes(), 40u);
}

}  // namespace
}  // namespace dymsum
