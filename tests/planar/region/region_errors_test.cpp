// Every error code of Region::create with its evidence.
#include <gtest/gtest.h>

#include <limits>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

struct Expected {
  ErrorCode code;
  Evidence evidence;
};

Evidence at(std::int64_t part, std::int64_t ring, std::optional<std::int64_t> vertex) {
  Evidence e;
  e.part = part;
  e.ring = ring;
  e.vertex = vertex;
  return e;
}

Evidence with_position(Evidence e, double x, double y) {
  e.x = x;
  e.y = y;
  return e;
}

Evidence with_other(Evidence e, std::optional<std::int64_t> part, std::optional<std::int64_t> ring,
                    std::optional<std::int64_t> vertex) {
  e.other_part = part;
  e.other_ring = ring;
  e.other_vertex = vertex;
  return e;
}

void expect_error(RegionData data, ErrorCode code, const Evidence& evidence) {
  const Result<Region> result = Region::create(std::move(data));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(name(result.error().code), name(code));
  EXPECT_FALSE(result.error().message.empty());
  EXPECT_EQ(result.error().evidence, evidence) << result.error().to_string();
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(RegionErrors, NotFiniteInRingPolylineAndPoint) {
  expect_error(with_holes(box(0, 0, 9, 9), {{{1, 1}, {1, 2}, {2, kNan}}}), ErrorCode::not_finite, at(0, 1, 2));
  expect_error(two_parts(box(0, 0, 1, 1), {{5, 5}, {kInfinity, 5}, {6, 6}}), ErrorCode::not_finite, at(1, 0, 1));
  Evidence line;
  line.ring = 1;
  line.vertex = 0;
  expect_error({{}, {{{0, 0}, {1, 1}}, {{-kInfinity, 0}, {1, 1}}}, {}}, ErrorCode::not_finite, line);
  Evidence point;
  point.vertex = 2;
  expect_error({{}, {}, {{0, 0}, {1, 1}, {0, kNan}}}, ErrorCode::not_finite, point);
}

TEST(RegionErrors, TooFewVertices) {
  expect_error(one_ring({{3, 4}, {1, 0}}), ErrorCode::too_few_vertices, with_position(at(0, 0, std::nullopt), 3, 4));
  expect_error(one_ring({}), ErrorCode::too_few_vertices, at(0, 0, std::nullopt));
  expect_error(with_holes(box(0, 0, 1, 1), {{}}), ErrorCode::too_few_vertices, at(0, 1, std::nullopt));
  Evidence line;
  line.ring = 0;
  line.x = 7;
  line.y = 8;
  expect_error({{}, {{{7, 8}}}, {}}, ErrorCode::too_few_vertices, line);
}

TEST(RegionErrors, RepeatedVertexInTheMiddleAndAtTheSeam) {
  expect_error(one_ring({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), ErrorCode::repeated_vertex,
               with_position(with_other(at(0, 0, 1), {}, {}, 2), 1, 0));
  expect_error(one_ring({{0, 0}, {1, 0}, {0, 1}, {-0.0, 0}}), ErrorCode::repeated_vertex,
               with_position(with_other(at(0, 0, 3), {}, {}, 0), 0, 0));
  Evidence line;
  line.ring = 0;
  line.vertex = 0;
  expect_error({{}, {{{5, 5}, {5, 5}, {6, 6}}}, {}}, ErrorCode::repeated_vertex,
               with_position(with_other(line, {}, {}, 1), 5, 5));
}

TEST(RegionErrors, NoArea) {
  expect_error(one_ring({{2, 2}, {4, 4}, {3, 3}, {9, 9}}), ErrorCode::no_area, with_position(at(0, 0, 0), 2, 2));
  expect_error(with_holes(box(0, 0, 9, 9), {{{1, 5}, {1, 3}, {1, 4}}}), ErrorCode::no_area,
               with_position(at(0, 1, 0), 1, 5));
}

TEST(RegionErrors, WrongOrientation) {
  expect_error(one_ring(reversed(box(1, 2, 3, 4))), ErrorCode::wrong_orientation, with_position(at(0, 0, 0), 1, 2));
  expect_error(with_holes(box(0, 0, 9, 9), {reversed(box(1, 1, 2, 2)), box(4, 3, 5, 5)}), ErrorCode::wrong_orientation,
               with_position(at(0, 2, 0), 4, 3));
}

TEST(RegionErrors, WrongOrientationIsSeenThoughTheSmallestPointIsVisitedTwice) {
  // Two triangles that touch in their leftmost point, as one ring: fine one way round, not the other.
  const Ring fan = {{0, 0}, {2, -2}, {2, -1}, {0, 0}, {2, 1}, {2, 2}};
  EXPECT_TRUE(Region::create(one_ring(fan)).ok());
  const Result<Region> wrong = Region::create(one_ring(reversed(fan)));
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().code, ErrorCode::wrong_orientation);
}

TEST(RegionErrors, SelfCrossingInEdges) {
  // Edge 0 meets edge 2 in (1, 1).
  expect_error(one_ring({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), ErrorCode::self_crossing,
               with_position(with_other(at(0, 0, 0), 0, 0, 2), 1, 1));
}

TEST(RegionErrors, SelfCrossingAtAVertexOnAnEdge) {
  // Vertex 2 lies on edge 0 and the ring passes to its other side.
  expect_error(one_ring({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {1, -2}, {-1, -2}}), ErrorCode::self_crossing,
               with_position(with_other(at(0, 0, 0), 0, 0, 3), 2, 0));
}

TEST(RegionErrors, SelfCrossingAtACommonVertex) {
  // The bow tie of SelfCrossingInEdges with both strands bent in the crossing.
  expect_error(one_ring({{0, 0}, {1, 1}, {2, 3}, {2, 0}, {1, 1}, {0, 2}}), ErrorCode::self_crossing,
               with_position(with_other(at(0, 0, 1), 0, 0, 4), 1, 1));
}

TEST(RegionErrors, SpikesOutwardAndInwardRunAlongThemselves) {
  expect_error(one_ring({{0, 0}, {2, 0}, {5, 0}, {2, 0}, {2, 2}}), ErrorCode::self_crossing,
               with_position(with_other(at(0, 0, 1), 0, 0, 2), 2, 0));
  expect_error(one_ring({{0, 0}, {4, 0}, {4, 4}, {2, 2}, {3, 3}, {0, 4}}), ErrorCode::self_crossing,
               with_position(with_other(at(0, 0, 2), 0, 0, 3), 2, 2));
}

TEST(RegionErrors, ARingThatCoversItselfTwice) {
  Ring twice = box(0, 0, 1, 1);
  const Ring once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  expect_error(one_ring(twice), ErrorCode::self_crossing, with_position(with_other(at(0, 0, 0), 0, 0, 4), 0, 0));
}

TEST(RegionErrors, RingsCrossProperly) {
  // Edge 1 of the first square, x = 2, meets edge 0 of the second, y = 1; edge 2 meets edge 3.
  const Result<Region> result = Region::create(two_parts(box(0, 0, 2, 2), box(1, 1, 3, 3)));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::rings_cross);
  EXPECT_EQ(result.error().evidence, with_position(with_other(at(0, 0, 2), 1, 0, 3), 1, 2))
      << result.error().to_string();
}

TEST(RegionErrors, RingsRunAlongEachOther) {
  expect_error(two_parts(box(0, 0, 1, 4), box(1, 2, 2, 3)), ErrorCode::rings_cross,
               with_position(with_other(at(0, 0, 1), 1, 0, 3), 1, 2));
  expect_error(with_holes(box(0, 0, 4, 4), {reversed(box(0, 0, 4, 4))}), ErrorCode::rings_cross,
               with_position(with_other(at(0, 0, 0), 0, 1, 3), 0, 0));
}

TEST(RegionErrors, HoleOutside) {
  expect_error(with_holes(box(0, 0, 2, 2), {reversed(box(5, 5, 6, 6))}), ErrorCode::hole_outside,
               with_position(at(0, 1, 0), 5, 5));
  expect_error(with_holes(box(1, 1, 2, 2), {reversed(box(0, 0, 6, 6))}), ErrorCode::hole_outside,
               with_position(at(0, 1, 0), 0, 0));
}

TEST(RegionErrors, HoleInsideAnotherHole) {
  expect_error(with_holes(box(0, 0, 9, 9), {reversed(box(1, 1, 8, 8)), reversed(box(3, 2, 4, 4))}),
               ErrorCode::hole_outside, with_position(with_other(at(0, 2, 0), 0, 1, {}), 3, 2));
}

TEST(RegionErrors, HoleOfOnePartInsideTheOther) {
  const Part a{box(0, 0, 2, 2), {reversed(box(11, 1, 12, 2))}};
  const Part b{box(10, 0, 13, 3), {}};
  expect_error({{a, b}, {}, {}}, ErrorCode::hole_outside, with_position(at(0, 1, 0), 11, 1));
}

TEST(RegionErrors, PartsOverlap) {
  expect_error(two_parts(box(0, 0, 9, 9), box(1, 2, 3, 4)), ErrorCode::parts_overlap,
               with_position(with_other(at(1, 0, 0), 0, 0, {}), 1, 2));
  // Part 0 fills the whole hole but touches no more than corners of it.
  const Part ring{box(-9, -9, 9, 9), {{{0, -2}, {-2, 0}, {0, 2}, {2, 0}}}};
  const Part inner{{{-1, 0}, {0, -1}, {1, 0}, {0, 1}}, {}};
  EXPECT_TRUE(Region::create({{inner, ring}, {}, {}}).ok());
  // A part around the hole of another one.
  const Part around{{{0, -3}, {3, 0}, {0, 3}, {-3, 0}}, {}};
  expect_error({{ring, around}, {}, {}}, ErrorCode::parts_overlap,
               with_position(with_other(at(1, 0, 3), 0, 0, {}), -3, 0));
}

TEST(RegionErrors, CrossingsComeBeforeOrientationAndNesting) {
  expect_error(with_holes(reversed(box(0, 0, 9, 9)), {{{20, 20}, {22, 22}, {22, 20}, {20, 22}}}),
               ErrorCode::self_crossing, with_position(with_other(at(0, 1, 0), 0, 1, 2), 21, 21));
}

}  // namespace
}  // namespace dymsum::test
