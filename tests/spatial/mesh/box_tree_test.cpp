// Boxes in a tree: the same tree, in one order, for any number of threads.
#include "spatial/mesh/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

namespace dymsum::spatial {
namespace {

TEST(BoxTree, finds_what_overlaps_in_the_same_order_for_any_number_of_threads) {
  constexpr std::uint32_t kSeed = 5;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  const auto below = [&](int n) { return static_cast<double>(random() % static_cast<std::uint32_t>(n)); };
  // Around the size from which threads share the work, and sizes that halves leave odd.
  for (const std::size_t n : {1, 4, 5, 2048, 2049, 4099, 10'001}) {
    std::vector<Box> boxes(n);
    for (Box& box : boxes) {
      box.add(Vec3{below(100), below(100), below(100)});
      box.grow(below(4));
    }
    const BoxTree one(boxes);
    const BoxTree two(boxes, 2);
    for (std::uint32_t i = 0; i < n; i += 1 + static_cast<std::uint32_t>(n / 20)) {
      std::vector<std::uint32_t> a, b, all;
      one.for_each(boxes[i], [&](std::uint32_t j) { a.push_back(j); });
      two.for_each(boxes[i], [&](std::uint32_t j) { b.push_back(j); });
      EXPECT_EQ(a, b) << n << " boxes";
      for (std::uint32_t j = 0; j < n; ++j)
        if (overlap(boxes[i], boxes[j])) all.push_back(j);
      std::sort(b.begin(), b.end());
      EXPECT_EQ(b, all);
    }
  }
}

/// Trees of two leaves: in each the boxes come in the order of their indices, however nth_element left them.
TEST(BoxTree, finds_what_overlaps_in_the_same_order_with_any_standard_library) {
  constexpr std::uint32_t kSeed = 6;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Box> boxes(5 + random() % 4);
    for (Box& box : boxes) box.add(Vec3{static_cast<double>(random() % 8), 0, 0});
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> found;
    tree.for_each(tree.bounds(), [&](std::uint32_t i) { found.push_back(i); });
    ASSERT_EQ(found.size(), boxes.size());
    const auto half = found.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2);
    EXPECT_TRUE(std::is_sorted(found.begin(), half)) << "trial " << trial;
    EXPECT_TRUE(std::is_sorted(half, found.end())) << "trial " << trial;
  }
}

}  // namespace
}  // namespace dymsum::spatial
