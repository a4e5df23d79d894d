#include "io/region/ring_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace dymsum::io {
namespace {

Ring square(double x, double y, double size) { return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}; }

TEST(RingOrder, sign_of_rings) {
  EXPECT_EQ(ring_sign({{0, 0}, {1, 0}, {0, 1}}), 1);
  EXPECT_EQ(ring_sign({{0, 0}, {0, 1}, {1, 0}}), -1);
  EXPECT_EQ(ring_sign({{0, 0}, {1, 1}, {2, 2}}), 0);
  EXPECT_EQ(ring_sign({{0, 0}, {1, 1}}), 0);
  EXPECT_EQ(ring_sign({{1, 1}, {1, 1}, {1, 1}}), 0);
}

TEST(RingOrder, duplicate_vertices_do_not_hide_the_sign) {
  EXPECT_EQ(ring_sign({{0, 0}, {0, 0}, {1, 0}, {0, 1}, {0, 1}, {0, 0}}), 1);
}

TEST(RingOrder, a_sliver_thinner_than_rounding_has_its_exact_sign) {
  const double x = 1e9, step = 0x1p-23;  // one unit in the last place of 1e9
  EXPECT_EQ(ring_sign({{-x, -x}, {x, x}, {x, x + step}}), 1);
  EXPECT_EQ(ring_sign({{-x, -x}, {x, x + step}, {x, x}}), -1);
}

// Two lobes that touch at the leftmost vertex: the ring passes there twice, and only the lowest ray tells its
// orientation.
TEST(RingOrder, a_ring_that_touches_itself_at_its_leftmost_vertex) {
  const Ring ring = {{0, 0}, {3, -3}, {3, -1}, {0, 0}, {3, 1}, {3, 3}};
  EXPECT_EQ(ring_sign(ring), 1);
  EXPECT_EQ(ring_sign(Ring(ring.rbegin(), ring.rend())), -1);
}

/// How often rings wind around a point that lies on none of them.
int winding(const std::vector<Ring>& rings, Point p) {
  int turns = 0;
  for (const Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x > p.x)
        turns += b.y > a.y ? 1 : -1;
    }
  }
  return turns;
}

TEST(RingOrder, nonzero_keeps_what_bounds_places_that_are_wound_around) {
  std::size_t left_out = 0;
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    // Squares on a quad-tree: inside, beside and around one another.
    std::vector<Ring> rings;
    for (int k = 0; k < 12; ++k) {
      const double size = 1 << (random() % 5), x = std::floor(random() % 32 / size) * size,
                   y = std::floor(random() % 32 / size) * size, gap = 0.2 / size;
      Ring ring = square(x + gap, y + gap, size - 2 * gap);
      if (std::count(rings.begin(), rings.end(), ring) +
              std::count(rings.begin(), rings.end(), Ring(ring.rbegin(), ring.rend())) >
          0)
        continue;
      if (random() % 2 == 0) std::reverse(ring.begin(), ring.end());
      rings.push_back(ring);
    }
    std::vector<Part> parts;
    ASSERT_TRUE(nest_rings(rings, parts, FillRule::nonzero));
    ASSERT_TRUE(Region::create({parts, {}, {}})) << seed;
    std::vector<Ring> kept;
    for (const Part& part : parts) {
      kept.push_back(part.outer);
      kept.insert(kept.end(), part.holes.begin(), part.holes.end());
    }
    left_out += rings.size() - kept.size();
    for (double x = 0.25; x < 32; x += 0.5)
      for (double y = 0.25; y < 32; y += 0.5)
        ASSERT_EQ(winding(kept, {x, y}), winding(rings, {x, y}) != 0) << seed << ": " << x << " " << y;
  }
  EXPECT_GT(left_out, 100u);
}

TEST(RingOrder, rings_inside_one_another_alternate_between_parts_and_holes) {
  std::vector<Ring> rings;
  for (int k = 0; k < 7; ++k) rings.push_back(square(k, k, 20 - 2 * k));
  std::vector<Part> parts;
  ASSERT_TRUE(nest_rings(rings, parts));
  ASSERT_EQ(parts.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(parts[k].outer, rings[2 * k]);
    EXPECT_EQ(parts[k].holes.size(), k < 3 ? 1u : 0u);
    if (k == 3) continue;
    EXPECT_EQ(parts[k].holes[0].front(), rings[2 * k + 1].front());
    EXPECT_EQ(ring_sign(parts[k].holes[0]), -1);
  }
}

// Every vertex of the diamond lies on the square, so its edges decide.
TEST(RingOrder, a_diamond_that_touches_its_square_with_every_vertex_is_a_hole) {
  const Ring diamond = {{2, 0}, {4, 2}, {2, 4}, {0, 2}};
  for (const bool diamond_first : {true, false}) {
    std::vector<Part> parts;
    ASSERT_TRUE(nest_rings(
        diamond_first ? std::vector<Ring>{diamond, square(0, 0, 4)} : std::vector<Ring>{square(0, 0, 4), diamond},
        parts));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].outer, square(0, 0, 4));
    EXPECT_EQ(parts[0].holes, (std::vector<Ring>{{{2, 0}, {0, 2}, {2, 4}, {4, 2}}}));
  }
}

TEST(RingOrder, neighbours_that_touch_are_parts) {
  std::vector<Part> parts;
  ASSERT_TRUE(nest_rings({square(0, 0, 2), square(2, 0, 2), square(0, 2, 2), square(1, 4, 1)}, parts));
  EXPECT_EQ(parts.size(), 4u);
}

TEST(RingOrder, a_ring_in_the_bay_of_another_is_a_part) {
  const Ring bay = {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}};
  std::vector<Part> parts;
  ASSERT_TRUE(nest_rings({bay, square(4, 5, 1), square(1, 1, 1)}, parts));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].holes.size(), 1u);
  EXPECT_EQ(parts[1].outer, square(4, 5, 1));
}

TEST(RingOrder, equal_rings_do_not_contain_each_other) {
  std::vector<Part> parts;
  ASSERT_TRUE(nest_rings({square(0, 0, 2), square(0, 0, 2)}, parts));
  EXPECT_EQ(parts.size(), 2u);
}

TEST(RingOrder, many_rings_side_by_side_are_fast) {
  std::vector<Ring> rings;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) rings.push_back(square(3 * i, 3 * j, 2));
  }
  for (int i = 0; i < 200; ++i) rings.push_back(square(3 * i + 0.5, 3 * i + 0.5, 1));
  std::vector<Part> parts;
  ASSERT_TRUE(nest_rings(rings, parts));
  EXPECT_EQ(parts.size(), 40000u);
}

}  // namespace
}  // namespace dymsum::io
