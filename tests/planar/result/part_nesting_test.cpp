#include "planar/result/planar_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

#include "planar/position/exact_source.h"
#include "planar/sum/listed_source.h"

namespace dymsum::planar {
namespace {

using Q = exact::BigRational;

constexpr double kAtError = 0x1p-40;

struct NestingTest : testing::Test {
  ListedSource source;
  std::vector<SumRing> rings;
  std::vector<std::uint8_t> is_outer;

  void outer(int x0, int y0, int x1, int y1) {
    rings.push_back(source.ring({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}));
    is_outer.push_back(1);
  }
  void hole(int x0, int y0, int x1, int y1) {
    rings.push_back(source.ring({{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}}));
    is_outer.push_back(0);
  }
  void hole(SumRing ring) {
    rings.push_back(std::move(ring));
    is_outer.push_back(0);
  }
  std::vector<SumPart> group(double at_error = kAtError) { return group_rings(rings, is_outer, source, at_error); }
  Point first_of(const SumRing& ring) { return ring.vertices.at(0).at; }
};

TEST_F(NestingTest, OneOuterTakesAllWithoutALook) {
  hole(1, 1, 2, 2);
  outer(0, 0, 9, 9);
  hole(3, 3, 4, 4);
  const std::vector<SumPart> parts = group();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(first_of(parts[0].outer), (Point{0, 0}));
  EXPECT_EQ(parts[0].holes.size(), 2u);
  EXPECT_EQ(source.queried, 0u);
  EXPECT_TRUE(group_rings({}, {}, source, 0).empty());
}

TEST_F(NestingTest, HolesGoToTheInnermostOuter) {
  outer(0, 0, 20, 20);
  hole(1, 1, 19, 19);
  outer(2, 2, 12, 12);
  hole(3, 3, 5, 5);
  hole(6, 3, 11, 11);
  outer(7, 4, 10, 10);
  hole(8, 5, 9, 6);
  outer(13, 13, 18, 18);
  hole(14, 14, 15, 15);
  const std::vector<SumPart> parts = group();
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].holes.size(), 1u);
  EXPECT_EQ(parts[1].holes.size(), 2u);
  EXPECT_EQ(parts[2].holes.size(), 1u);
  EXPECT_EQ(first_of(parts[2].holes[0]), (Point{8, 5}));
  EXPECT_EQ(parts[3].holes.size(), 1u);
  EXPECT_EQ(source.queried, 0u) << "doubles decide all of this";
}

TEST_F(NestingTest, TheExactPathAgrees) {
  outer(0, 0, 20, 20);
  hole(1, 1, 19, 19);
  outer(2, 2, 12, 12);
  hole(3, 3, 5, 5);
  for (const double at_error : {1e3, std::numeric_limits<double>::infinity()}) {
    const std::vector<SumPart> parts = group(at_error);
    EXPECT_EQ(first_of(parts[0].holes.at(0)), (Point{1, 1}));
    EXPECT_EQ(first_of(parts[1].holes.at(0)), (Point{3, 3}));
  }
  EXPECT_GT(source.queried, 0u);
}

TEST_F(NestingTest, AHoleMayTouchItsOuterEverywhere) {
  outer(0, 0, 4, 4);
  outer(10, 0, 14, 4);
  outer(20, 20, 21, 21);
  hole(source.ring({{2, 0}, {0, 2}, {2, 4}, {4, 2}}));      // all vertices inside edges of the outer ring
  hole(source.ring({{10, 0}, {11, 3}, {14, 4}, {13, 1}}));  // touches at two corners
  for (const double at_error : {kAtError, 1e3}) {
    const std::vector<SumPart> parts = group(at_error);
    EXPECT_EQ(parts[0].holes.size(), 1u);
    EXPECT_EQ(parts[1].holes.size(), 1u);
    EXPECT_EQ(parts[2].holes.size(), 0u);
  }
}

// A square with notches that reach all three vertices of the hole, and the point 1/18 up its first edge, which the
// exact path (16 vertices, so fractions k/18) tries first after the vertices.
TEST_F(NestingTest, TouchingAtAllVerticesIsDecidedInsideAnEdge) {
  const SumRing notched = source.ring({{-10, -10},
                                       {-1, -10},
                                       {0, 0},
                                       {1, -10},
                                       {10, -10},
                                       {10, 0},
                                       {3, 2},
                                       {10, 4},
                                       {10, 10},
                                       {1, 10},
                                       {0, 4},
                                       {-1, 10},
                                       {-10, 10},
                                       {-10, 3},
                                       {0, Q(2, 9)},
                                       {-10, 1}});
  const SumRing inner = source.ring({{0, 0}, {0, 4}, {3, 2}});
  const SumRing in_notch = source.ring({{Q(-1, 2), 7}, {Q(1, 2), 7}, {0, 9}});
  for (const double at_error : {kAtError, 1e6}) {
    EXPECT_TRUE(ring_contains(notched, inner, source, at_error));
    EXPECT_FALSE(ring_contains(notched, in_notch, source, at_error));
  }
  EXPECT_GT(source.queried, 0u);
}

TEST_F(NestingTest, AHoleWithoutOuterIsABrokenContract) {
  hole(0, 0, 1, 1);
  EXPECT_THROW(group(), std::logic_error);
  outer(5, 5, 6, 6);
  outer(8, 8, 9, 9);
  EXPECT_THROW(group(), std::logic_error);
  is_outer.pop_back();
  EXPECT_THROW(group(), std::logic_error);
}

// ---- canonical order

std::vector<Point> points_of(const SumRing& ring) {
  std::vector<Point> points;
  for (const SumVertex& v : ring.vertices) points.push_back(v.at);
  return points;
}

TEST(Canonical, RingsStartAtTheSmallestVertex) {
  ListedSource source;
  std::vector<SumPart> parts{{source.ring({{4, 0}, {4, 4}, {0, 4}, {0, 0}}), {}}};
  canonicalize(parts, source, kAtError);
  EXPECT_EQ(points_of(parts[0].outer), (std::vector<Point>{{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
}

TEST(Canonical, DoublesDecideWhereTheyCan) {
  ListedSource source;
  std::vector<SumPart> parts{{source.ring({{4, 1}, {2, 5}, {0, 3}}), {source.ring({{3, 2}, {1, 3}, {2, 3}})}},
                             {source.ring({{-4, 1}, {-2, 5}, {-5, 3}}), {}}};
  canonicalize(parts, source, kAtError);
  EXPECT_EQ(source.queried, 0u);
  EXPECT_EQ(parts[0].outer.vertices[0].at, (Point{-5, 3}));
  EXPECT_EQ(parts[1].outer.vertices[0].at, (Point{0, 3}));
}

TEST(Canonical, CloseDoublesAreDecidedExactly) {
  ListedSource source;
  SumRing ring;
  const double off = kAtError / 2;
  ring.vertices = {source.add(4, 0), source.add(Q(1, 1000000) * power_of_two(-50), 1, -off, 0),
                   source.add(0, 3, off, 0)};  // at the wrong way round
  std::vector<SumPart> parts{{ring, {}}};
  canonicalize(parts, source, kAtError);
  EXPECT_EQ(parts[0].outer.vertices[0].at.y, 3);
  EXPECT_GT(source.queried, 0u);
}

TEST(Canonical, APinchedRingStartsWhereItContinuesSmallest) {
  const auto make = [](std::size_t shift, ListedSource& source) {
    // visits (0, 0) twice
    SumRing ring = source.ring({{0, 0}, {4, -2}, {4, -1}, {0, 0}, {4, 1}, {4, 2}});
    std::rotate(ring.vertices.begin(), ring.vertices.begin() + static_cast<std::ptrdiff_t>(shift), ring.vertices.end());
    std::vector<SumPart> parts{{ring, {}}};
    canonicalize(parts, source, kAtError);
    return points_of(parts[0].outer);
  };
  for (std::size_t shift = 0; shift < 6; ++shift) {
    ListedSource source;
    EXPECT_EQ(make(shift, source), (std::vector<Point>{{0, 0}, {4, -2}, {4, -1}, {0, 0}, {4, 1}, {4, 2}})) << shift;
  }
}

TEST(Canonical, EveryOrderOfAGrateBecomesTheSame) {
  constexpr unsigned kSeed = 99;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::vector<std::vector<std::vector<Point>>> results;
  for (int round = 0; round < 5; ++round) {
    ListedSource source;
    SumPart part{source.ring({{0, 0}, {50, 0}, {50, 50}, {0, 50}}), {}};
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const Q x = 4 * i + Q(1, 3), y = 4 * j + Q(1, 3);
        SumRing hole = source.ring({{x, y}, {x, y + 2}, {x + 2, y + 2}, {x + 2, y}});
        std::rotate(hole.vertices.begin(), hole.vertices.begin() + static_cast<std::ptrdiff_t>(random() % 4),
                    hole.vertices.end());
        part.holes.push_back(hole);
      }
    std::shuffle(part.holes.begin(), part.holes.end(), random);
    std::vector<SumPart> parts{part};
    canonicalize(parts, source, kAtError);
    std::vector<std::vector<Point>> all;
    for (const SumRing& hole : parts[0].holes) all.push_back(points_of(hole));
    results.push_back(all);
  }
  EXPECT_LT(results[0][0][0].y, results[0][1][0].y);
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST(Canonical, RingsThatTouchAtTheirSmallestVertexAreOrderedByTheNext) {
  for (const bool swap : {false, true}) {
    ListedSource source;
    SumPart low{source.ring({{0, 0}, {4, -2}, {4, -1}}), {}}, high{source.ring({{0, 0}, {4, 1}, {4, 2}}), {}};
    std::vector<SumPart> parts{low, high};
    if (swap) std::swap(parts[0], parts[1]);
    canonicalize(parts, source, kAtError);
    EXPECT_EQ(parts[0].outer.vertices[1].at.y, -2);
  }
}

TEST(Canonical, SegmentsAndPointsAreDirectedSortedAndListedOnce) {
  ListedSource source;
  std::vector<SumSegment> segments{{source.add(5, 0), source.add(3, 0)},
                                   {source.add(0, 1), source.add(0, 4)},
                                   {source.add(3, 0), source.add(5, 0)},
                                   {source.add(0, 3), source.add(0, 1)}};
  canonicalize(segments, source, kAtError);
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0].to.at, (Point{0, 3}));
  EXPECT_EQ(segments[1].to.at, (Point{0, 4}));
  EXPECT_EQ(segments[2].from.at, (Point{3, 0}));
  std::vector<SumVertex> points{source.add(Q(1, 3), 0), source.add(0, 0), source.add(Q(1, 3), 0)};
  canonicalize(points, source, kAtError);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].at.x, 0);
}

}  // namespace
}  // namespace dymsum::planar
