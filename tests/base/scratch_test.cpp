#include "base/scratch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <random>

namespace dymsum {
namespace {

// Blocks of all sizes in random order of life: none overlaps another, all are aligned, and none loses what was written into it.
TEST(Scratch, BlocksAreDisjointAlignedAndKeepTheirContents) {
  constexpr std::uint32_t kSeed = 7;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  for (int round = 0; round < 20; ++round) {
    Scratch scratch;
    struct Block {
      std::size_t size, alignment;
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
        const std::size_t alignment = std::size_t{1} << (random() % 5);
        auto* at = static_cast<unsigned char*>(scratch.allocate(size, alignment));
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(at) % alignment, 0u);
        const auto after = blocks.lower_bound(at);
        if (after != blocks.end()) {
          ASSERT_LE(at + size, after->first);
        }
        if (after != blocks.begin()) {
          const auto before = std::prev(after);
          ASSERT_LE(before->first + before->second.size, at);
        }
        const Block block{size, alignment, static_cast<unsigned char>(step)};
        std::memset(at, block.fill, size);
        blocks.emplace(at, block);
      } else {
        const auto it = std::next(blocks.begin(), static_cast<std::ptrdiff_t>(random() % blocks.size()));
        check(it->first, it->second);
        scratch.deallocate(it->first, it->second.size, it->second.alignment);
        blocks.erase(it);
      }
    }
    for (const auto& [at, block] : blocks) {
      check(at, block);
      scratch.deallocate(at, block.size, block.alignment);
    }
  }
}

TEST(Scratch, TellsTheMostBytesHandedOutAtOneTime) {
  Scratch scratch;
  void* const small = scratch.allocate(1000, 8);
  void* const large = scratch.allocate(100000, 8);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
  scratch.deallocate(large, 100000, 8);
  void* const other = scratch.allocate(5000, 8);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
  scratch.deallocate(other, 5000, 8);
  scratch.deallocate(small, 1000, 8);
  EXPECT_EQ(scratch.peak_bytes(), 101000u);
}

}  // namespace
}  // namespace dymsum
