// The sweep over boxes against looking at all pairs.
#include "base/box_sweep.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "oracles/random.h"

namespace dymsum {
namespace {

TEST(BoxSweep, finds_the_boxes_that_meet_once_each_and_only_wanted_ones) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    oracles::Random random(seed);
    std::vector<BoxQuanta> boxes(seed % 3 == 0 ? 200 : seed);
    const auto number = [&](int below) { return static_cast<std::int16_t>(random.below(below)); };
    for (BoxQuanta& b : boxes) {
      b.x0 = number(3000);
      b.y0 = number(3000);
      b.x1 = static_cast<std::int16_t>(b.x0 + number(500));
      b.y1 = static_cast<std::int16_t>(b.y0 + number(500));
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    std::size_t decided = 0;
    std::int16_t left = 0;
    Scratch scratch;
    sweep_boxes(
        boxes, &scratch,
        [&](std::uint32_t k, std::uint32_t) {
          EXPECT_GE(boxes[k].x0, left) << "the order of left sides";
          left = boxes[k].x0;
          return [k](std::uint32_t other) { return (k + other) % 5 != 0; };
        },
        [&](std::uint32_t k, std::span<const std::uint32_t> others) {
          for (const std::uint32_t other : others) found.insert(std::minmax(k, other));
          decided += others.size();
        });
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
        const BoxQuanta &u = boxes[a], &v = boxes[b];
        if (u.x0 <= v.x1 && v.x0 <= u.x1 && u.y0 <= v.y1 && v.y0 <= u.y1 && (a + b) % 5 != 0) expected.emplace(a, b);
      }
    // Lanes after the last box that starts in time may be reported: their boxes meet in y alone.
    for (const auto& pair : expected) ASSERT_TRUE(found.contains(pair)) << "seed " << seed;
    EXPECT_EQ(decided, found.size());
    for (const auto& [a, b] : found) {
      ASSERT_TRUE(boxes[a].y0 <= boxes[b].y1 && boxes[b].y0 <= boxes[a].y1);
      ASSERT_NE((a + b) % 5, 0u);
    }
  }
}

}  // namespace
}  // namespace dymsum
