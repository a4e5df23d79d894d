// Pairs of boxes that overlap, against all pairs one by one.
#include "spatial/arrangement/near_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dymsum::spatial {
namespace {

NearPairs found(const std::vector<Box>& boxes, int threads) {
  SpatialOptions options;
  options.threads = threads;
  SpatialStats stats;
  StageWatch watch(options, stats);
  return near_pairs(boxes, watch);
}

void expect_all_pairs(const std::vector<Box>& boxes) {
  const NearPairs one = found(boxes, 1), three = found(boxes, 3);
  ASSERT_EQ(one.begin.size(), boxes.size() + 1);
  for (std::uint32_t f = 0; f < boxes.size(); ++f) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t g = f + 1; g < boxes.size(); ++g)
      if (overlap(boxes[f], boxes[g])) expected.push_back(g);
    ASSERT_EQ(std::vector<std::uint32_t>(one.of(f).begin(), one.of(f).end()), expected) << "box " << f;
  }
  EXPECT_EQ(one.others, three.others);
}

/// Corners are multiples of 1 / `steps`, so that many boxes touch.
std::vector<Box> boxes(std::size_t count, int steps, double size, double scale, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&](double most) {
    return std::floor(most * steps * std::ldexp(static_cast<double>(random() >> 11), -53)) / steps;
  };
  std::vector<Box> all(count);
  for (Box& b : all) {
    const Vec3 low{number(2) - 1, number(2) - 1, number(2) - 1};
    b.add(scale * low), b.add(scale * (low + Vec3{number(size), number(size), number(size)}));
  }
  return all;
}

TEST(NearPairs, AreAllOfThem) {
  for (const std::size_t count : {0, 1, 2, 15, 16, 17, 31, 32, 33, 48, 100, 257, 1000})
    for (const int steps : {4, 64, 1 << 20}) expect_all_pairs(boxes(count, steps, 0.25, 1, count + steps));
}

// Floats tell neither boxes far below their own digits apart, nor do they hold what is as large as doubles can be.
TEST(NearPairs, OfAnySize) {
  for (const double scale : {0x1p-1000, 0x1p-150, 0x1p150, 0x1p1000}) expect_all_pairs(boxes(200, 16, 0.5, scale, 1));
  std::vector<Box> mixed = boxes(100, 64, 0.5, 1, 2);
  for (const Box& b : boxes(100, 64, 0.5, 0x1p-40, 3)) mixed.push_back(b);
  for (const Box& b : boxes(20, 64, 0.5, 0x1p60, 4)) mixed.push_back(b);
  expect_all_pairs(mixed);
}

TEST(NearPairs, OfEqualBoxesAndPoints) {
  std::vector<Box> same(70);
  for (Box& b : same) b.add(Vec3{1, 2, 3});
  expect_all_pairs(same);
  expect_all_pairs(std::vector<Box>(40, Box{{0, 0, 0}, {0, 0, 0}}));
}

/// Groups of boxes, some of them empty, against all pairs one by one.
void expect_pairs_between(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& first) {
  const SpatialOptions options;
  SpatialStats stats;
  StageWatch watch(options, stats);
  const NearPairs found = near_pairs_between(boxes, first, watch);
  const auto group = [&](std::uint32_t f) { return std::upper_bound(first.begin(), first.end(), f) - first.begin(); };
  ASSERT_EQ(found.begin.size(), boxes.size() + 1);
  for (std::uint32_t f = 0; f < boxes.size(); ++f) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t g = f + 1; g < boxes.size(); ++g)
      if (group(f) != group(g) && overlap(boxes[f], boxes[g])) expected.push_back(g);
    ASSERT_EQ(std::vector<std::uint32_t>(found.of(f).begin(), found.of(f).end()), expected) << "box " << f;
  }
}

TEST(NearPairs, BetweenGroups) {
  for (const int steps : {4, 64, 1 << 20}) {
    expect_pairs_between(boxes(400, steps, 0.25, 1, 5), {0, 130, 400});
    expect_pairs_between(boxes(400, steps, 0.5, 1, 6), {0, 1, 1, 200, 200, 390, 400, 400});
    expect_pairs_between(boxes(300, steps, 0.05, 1, 7), {0, 300});
    expect_pairs_between(boxes(60, steps, 2, 0x1p1000, 8), {0, 20, 40, 60});
  }
  expect_pairs_between({}, {0});
  expect_pairs_between({}, {0, 0, 0});
  std::vector<Box> same(120);
  for (Box& b : same) b.add(Vec3{1, 2, 3});
  expect_pairs_between(same, {0, 60, 100, 120});
}

// Eight million pairs of 64 MB, of which none counted.
TEST(NearPairs, CountBeforeTheyAreHeld) {
  std::vector<Box> same(4000);
  for (Box& b : same) b.add(Vec3{1, 2, 3});
  for (const int threads : {1, 2}) {
    SpatialOptions options;
    options.threads = threads;
    options.memory = 3'000'000;
    SpatialStats stats;
    StageWatch watch(options, stats);
    try {
      near_pairs(same, watch);
      FAIL() << "more than the budget is held";
    } catch (const OverBudget& e) {
      EXPECT_GT(e.bytes, options.memory);
      EXPECT_LT(e.bytes, 2 * options.memory);
    }
  }
}

}  // namespace
}  // namespace dymsum::spatial
