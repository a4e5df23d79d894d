// Equal sets are equal values, however they are written; and the numbers a region tells about itself.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

Region make(RegionData data) { return Region::create(std::move(data)).value(); }

Ring rotated(Ring ring, std::ptrdiff_t by) {
  std::rotate(ring.begin(), ring.begin() + by, ring.end());
  return ring;
}

const Ring kOuter = {{0, 0}, {12, 0}, {12, 12}, {0, 12}};
const Ring kHole = {{1, 1}, {1, 3}, {3, 3}};
const Ring kOtherHole = {{12, 6}, {8, 5}, {8, 7}};

TEST(RegionCanonical, StartVertexDoesNotMatter) {
  const Region region = make(with_holes(kOuter, {kHole}));
  for (std::ptrdiff_t i = 0; i < 4; ++i) {
    for (std::ptrdiff_t j = 0; j < 3; ++j) {
      const Region other = make(with_holes(rotated(kOuter, i), {rotated(kHole, j)}));
      EXPECT_EQ(region, other);
      EXPECT_EQ(region.canonical().data(), other.canonical().data());
    }
  }
}

TEST(RegionCanonical, InsertedCollinearVerticesDoNotMatter) {
  const Ring outer = {{4, 0}, {12, 0}, {12, 6}, {12, 12}, {0.5, 12}, {0, 12}, {0, 0}, {0.1, 0}};
  EXPECT_EQ(make(with_holes(kOuter, {kHole})), make(with_holes(outer, {{{1, 1}, {1, 2}, {1, 3}, {3, 3}, {2, 2}}})));
  EXPECT_EQ(make(one_ring(outer)).canonical().parts()[0].outer, (Ring{{0, 0}, {12, 0}, {12, 12}, {0, 12}}));
  // Not quite collinear is another set.
  EXPECT_NE(make(one_ring(kOuter)), make(one_ring({{0, 0}, {6, std::nextafter(0.0, 1)}, {12, 0}, {12, 12}, {0, 12}})));
}

TEST(RegionCanonical, OrderOfPartsHolesPolylinesAndPointsDoesNotMatter) {
  const Part a{kOuter, {kHole, kOtherHole}};
  const Part b{box(20, 0, 21, 1), {}};
  const Part c{box(-9, 5, -8, 6), {}};
  const RegionData one{{a, b, c}, {{{0, 0}, {5, 5}}, {{1, 1}, {0, 3}}}, {{7, 7}, {1, 2}}};
  const RegionData other{{c, {kOuter, {kOtherHole, kHole}}, b}, {{{1, 1}, {0, 3}}, {{0, 0}, {5, 5}}}, {{1, 2}, {7, 7}}};
  EXPECT_EQ(make(one), make(other));
  EXPECT_EQ(make(one).canonical().data(), make(other).canonical().data());
  EXPECT_NE(make(one), make({{a, b}, one.polylines, one.points}));
  EXPECT_NE(make(one), make({one.parts, {{{0, 0}, {5, 5}}}, one.points}));
  EXPECT_NE(make(one), make({one.parts, one.polylines, {{7, 7}}}));
}

TEST(RegionCanonical, ARingThroughItsSmallestPointTwiceHasOneStart) {
  const Ring fan = {{0, 0}, {2, -2}, {2, -1}, {0, 0}, {2, 1}, {2, 2}};
  for (std::ptrdiff_t i = 0; i < 6; ++i) EXPECT_EQ(make(one_ring(rotated(fan, i))).canonical().parts()[0].outer, fan);
}

TEST(RegionCanonical, PolylinesRunFromTheSmallerEnd) {
  const Region region = make({{}, {{{3, 3}, {2, 2}, {1, 1}, {1, 5}}}, {}});
  EXPECT_EQ(region.canonical().polylines()[0], (Polyline{{1, 5}, {1, 1}, {3, 3}}));
  EXPECT_EQ(region, make({{}, {{{1, 5}, {1, 1}, {3, 3}}, {{3, 3}, {1, 1}, {1, 5}}}, {}}));
  // Folds stay.
  const Region fold = make({{}, {{{0, 0}, {5, 0}, {2, 0}}}, {}});
  EXPECT_EQ(fold.canonical().polylines()[0].size(), 3u);
}

TEST(RegionCanonical, ClosedPolylinesHaveOneStartAndDirection) {
  const Ring loop = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}};
  const Polyline expected = {{0, 0}, {0, 4}, {4, 4}, {4, 0}, {0, 0}};
  for (std::ptrdiff_t i = 0; i < 5; ++i) {
    for (const Ring& ring : {rotated(loop, i), reversed(rotated(loop, i))}) {
      Polyline line = ring;
      line.push_back(line.front());
      EXPECT_EQ(make({{}, {line}, {}}).canonical().polylines()[0], expected);
    }
  }
}

TEST(RegionCanonical, DuplicatesAndNegativeZerosDisappear) {
  const Region region = make({{}, {}, {{1, 1}, {-0.0, 0}, {1, 1}, {0, -0.0}}});
  const Region canonical = region.canonical();
  ASSERT_EQ(canonical.points().size(), 2u);
  EXPECT_FALSE(std::signbit(canonical.points()[0].x));
  EXPECT_FALSE(std::signbit(canonical.points()[0].y));
  EXPECT_EQ(region, make({{}, {}, {{0, 0}, {1, 1}}}));
}

TEST(RegionCanonical, CanonicalIsIdempotentAndEqualToTheOriginal) {
  const Region region = make({{{rotated(kOuter, 2), {kOtherHole, kHole}}}, {{{5, 5}, {1, 1}}}, {{3, 3}}});
  EXPECT_EQ(region.canonical(), region);
  EXPECT_EQ(region.canonical().canonical().data(), region.canonical().data());
  EXPECT_TRUE(Region::create(region.canonical().data()).ok());
}

TEST(RegionNumbers, Counts) {
  const Region region = make({{{kOuter, {kHole, kOtherHole}}, {box(20, 0, 21, 1), {}}}, {{{0, 0}, {5, 5}}}, {{7, 7}}});
  EXPECT_EQ(region.vertex_count(), 4u + 3 + 3 + 4 + 2 + 1);
  EXPECT_EQ(region.hole_count(), 2u);
  EXPECT_FALSE(region.empty());
  EXPECT_TRUE(Region().empty());
  EXPECT_EQ(Region().vertex_count(), 0u);
  EXPECT_FALSE(make({{}, {}, {{0, 0}}}).empty());
}

TEST(RegionNumbers, Bounds) {
  EXPECT_EQ(bounds(Region()), (std::array<double, 4>{0, 0, 0, 0}));
  EXPECT_EQ(bounds(make({{{kOuter, {}}}, {{{-3, 5}, {5, 5}}}, {{7, 99}}})), (std::array<double, 4>{-3, 0, 12, 99}));
}

TEST(RegionNumbers, AreaIsExactFarAway) {
  EXPECT_EQ(area(Region()), 0);
  EXPECT_EQ(area(make(with_holes(kOuter, {kHole, kOtherHole}))), 144 - 2 - 4);
  const double far = 1e15;
  EXPECT_EQ(area(make(one_ring(box(far, -far, far + 1, 1 - far)))), 1);
  EXPECT_EQ(area(make(one_ring({{far, far}, {far + 1, far}, {2 * far, 2 * far}}))), far / 2);
  // 0.1 * 0.3 of the doubles themselves, rounded once.
  EXPECT_EQ(area(make(one_ring(box(0, 0, 0.1, 0.3)))), 0.1 * 0.3);
}

TEST(RegionNumbers, AreaAtTheEndsOfTheRange) {
  EXPECT_EQ(area(make(one_ring(box(-1e300, 0, 1e300, 1e-300)))), 2);
  EXPECT_EQ(area(make(one_ring(box(0, 0, 1e200, 1e200)))), std::numeric_limits<double>::infinity());
  EXPECT_EQ(area(make(one_ring(box(0, 0, std::ldexp(1, -1074), 1)))), std::ldexp(1, -1074));
}

}  // namespace
}  // namespace dymsum::test
