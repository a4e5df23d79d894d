// Rings may touch at points, however many meet there.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

std::string touching_verdict(RegionData data) {
  const Result<Region> result = Region::create(std::move(data));
  return result.ok() ? "valid" : std::string(name(result.error().code));
}

TEST(RegionTouching, HoleTouchesOuterRingAtAVertexOfEither) {
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 4}, {2, 5}, {2, 3}}})), "valid");  // vertex on edge
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 0}, {1, 2}, {2, 1}}})), "valid");  // vertex on vertex
  EXPECT_EQ(touching_verdict(with_holes({{0, 0}, {8, 0}, {8, 8}, {4, 4}, {0, 8}}, {{{2, 4}, {6, 4}, {4, 2}}})),
            "valid");
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 4}, {4, 8}, {8, 4}, {4, 0}}})),
            "valid");  // in four places
  // The same from outside.
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 4}, {-2, 3}, {-2, 5}}})), "hole_outside");
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 0}, {-2, -1}, {-1, 2}}})), "hole_outside");
  // Half in, half out.
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {{{0, 4}, {2, 5}, {-2, 9}}})), "rings_cross");
}

TEST(RegionTouching, HolesTouchEachOther) {
  const Ring left = {{2, 4}, {3, 6}, {4, 4}, {3, 2}};
  const Ring right = {{4, 4}, {5, 6}, {6, 4}, {5, 2}};
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {left, right})), "valid");
  const Ring inside_left = {{4, 4}, {3, 3}, {3, 5}};
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {left, inside_left})), "hole_outside");
  EXPECT_EQ(touching_verdict(with_holes(box(0, 0, 8, 8), {inside_left, left})), "hole_outside");
}

TEST(RegionTouching, PartsTouch) {
  EXPECT_EQ(touching_verdict(two_parts(box(0, 0, 2, 2), box(2, 2, 4, 4))), "valid");
  EXPECT_EQ(touching_verdict(two_parts(box(0, 0, 2, 2), {{2, 1}, {4, 0}, {4, 4}})), "valid");
  EXPECT_EQ(touching_verdict(two_parts(box(0, 0, 4, 4), {{0, 0}, {2, 1}, {1, 2}})), "parts_overlap");
  EXPECT_EQ(touching_verdict(two_parts({{0, 0}, {2, 1}, {1, 2}}, box(0, 0, 4, 4))), "parts_overlap");
}

TEST(RegionTouching, APartInAHoleMayTouchItAndHoldAHoleWithAPart) {
  const Part a{box(0, 0, 20, 20), {reversed(box(2, 2, 18, 18))}};
  const Part b{{{2, 10}, {10, 2}, {18, 10}, {10, 18}}, {reversed(box(7, 7, 13, 13))}};
  const Part c{{{7, 7}, {12, 8}, {8, 12}}, {}};
  EXPECT_EQ(touching_verdict({{a, b, c}, {}, {}}), "valid");
  EXPECT_EQ(touching_verdict({{c, a, b}, {}, {}}), "valid");
  EXPECT_EQ(touching_verdict({{c, a}, {}, {}}), "valid");
  EXPECT_EQ(touching_verdict({{c, Part{b.outer, {}}, a}, {}, {}}), "parts_overlap");
}

TEST(RegionTouching, ARingTouchesItself) {
  // A vertex on an edge, from inside and from outside; a corner on a corner; a hole that hangs on the outer ring.
  EXPECT_EQ(touching_verdict(one_ring({{0, 0}, {8, 0}, {8, 4}, {4, 0}, {0, 4}})), "valid");
  EXPECT_EQ(touching_verdict(one_ring({{0, 0}, {4, 0}, {4, 2}, {6, 2}, {4, 1}, {8, 1}, {8, 4}, {0, 4}})), "valid");
  EXPECT_EQ(touching_verdict(one_ring({{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}})), "valid");
  EXPECT_EQ(touching_verdict(one_ring({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 3}, {3, 1}})), "valid");
  // The hanging hole run the other way would be covered twice.
  EXPECT_EQ(touching_verdict(one_ring({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 1}, {1, 3}})), "self_crossing");
}

TEST(RegionTouching, TouchingWithoutCrossingThroughAStraightVertex) {
  // Three strands through (4, 4): two straight ones would cross, two bent ones beside a straight one do not.
  EXPECT_EQ(touching_verdict(two_parts({{0, 0}, {4, 4}, {8, 8}, {0, 8}}, {{0, 0}, {8, 0}, {4, 4}})), "rings_cross");
  EXPECT_EQ(touching_verdict(two_parts({{0, 0}, {4, 4}, {8, 8}, {0, 8}}, {{2, 0}, {8, 2}, {4, 4}})), "valid");
}

// Petals around one point, each a triangle between directions on a square of the given half side.
std::vector<Ring> petals(int count, int half) {
  std::vector<Point> around;
  for (int i = -half; i < half; ++i) around.push_back({double(i), double(-half)});
  for (int i = -half; i < half; ++i) around.push_back({double(half), double(i)});
  for (int i = half; i > -half; --i) around.push_back({double(i), double(half)});
  for (int i = half; i > -half; --i) around.push_back({double(-half), double(i)});
  std::vector<Ring> rings;
  for (int i = 0; i < count; ++i) {
    rings.push_back({{0, 0}, around[static_cast<std::size_t>(2 * i)], around[static_cast<std::size_t>(2 * i + 1)]});
  }
  return rings;
}

TEST(RegionTouching, ManyPartsMeetInOnePoint) {
  const int half = 20000;
  RegionData flower;
  for (Ring& ring : petals(4 * half, half)) flower.parts.push_back({std::move(ring), {}});
  EXPECT_EQ(touching_verdict(flower), "valid");
  flower.parts[7777].outer[1] = {-flower.parts[7777].outer[1].x, -flower.parts[7777].outer[1].y};
  EXPECT_NE(touching_verdict(flower), "valid");
}

TEST(RegionTouching, ManyHolesMeetInOnePointOfTheOuterRing) {
  RegionData data = with_holes({{0, 0}, {9000, -9000}, {9000, 9000}}, {});
  for (Ring& ring : petals(4000, 2000)) {
    if (ring[1].x > std::abs(ring[1].y) && ring[2].x > std::abs(ring[2].y)) {
      data.parts[0].holes.push_back(reversed(std::move(ring)));
    }
  }
  ASSERT_EQ(data.parts[0].holes.size(), 1999u);
  EXPECT_EQ(touching_verdict(data), "valid");
}

TEST(RegionTouching, OneRingOfManyPetals) {
  Ring ring;
  for (const Ring& petal : petals(80000, 20000)) ring.insert(ring.end(), petal.begin(), petal.end());
  EXPECT_EQ(touching_verdict(one_ring(ring)), "valid");
  EXPECT_EQ(touching_verdict(one_ring(reversed(ring))), "wrong_orientation");
}

TEST(RegionTouching, PolylinesAndPointsMayLieAnywhere) {
  RegionData data = one_ring(box(0, 0, 4, 4));
  data.polylines = {{{-1, -1}, {9, 9}}, {{0, 0}, {4, 0}}, {{1, 1}, {2, 2}, {1, 1}}};
  data.polylines.push_back({{0, 0}, {4, 4}, {4, 0}, {0, 4}, {0, 0}});
  data.points = {{0, 0}, {2, 2}, {2, 2}, {99, 99}};
  EXPECT_EQ(touching_verdict(data), "valid");
}

}  // namespace
}  // namespace dymsum::test
