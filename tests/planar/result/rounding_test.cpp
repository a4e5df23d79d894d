#include "planar/result/rounding.h"

#include <gtest/gtest.h>

#include <memory>

#include "exact/orient.h"
#include "planar/sum/listed_source.h"

namespace dymsum {
namespace {

using Q = exact::BigRational;

struct RoundingTest : testing::Test {
  std::shared_ptr<ListedSource> source = std::make_shared<ListedSource>();
  PlanarSum sum;

  RoundingTest() { exact_source(sum) = source; }
  void part(SumRing outer, std::vector<SumRing> holes = {}) {
    sum.parts.push_back({std::move(outer), std::move(holes)});
  }
  void segment(Q ax, Q ay, Q bx, Q by) { sum.segments.push_back({source->add(ax, ay), source->add(bx, by)}); }
  void expect_error(const std::string& words) {
    const Result<Region> result = sum.rounded();
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::rounding_changed_topology);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().to_string();
  }
};

TEST_F(RoundingTest, EmptySumIsTheEmptyRegion) {
  EXPECT_TRUE(PlanarSum().rounded().value().empty());
  EXPECT_FALSE(PlanarSum().rounded_with_repair().value().report.changed());
}

TEST_F(RoundingTest, EveryVertexIsTheNearestDouble) {
  part(source->ring({{0, 0}, {Q(1, 3), 0}, {Q(2, 3), Q(1, 7)}}));
  sum.parts[0].outer.vertices[1].at = {9, 9};  // never read
  segment(Q(4, 3), 1, Q(5, 3), 1);
  sum.points.push_back(source->add(Q(-1, 3), Q(-1, 10)));
  const Region region = sum.rounded().value();
  const Ring expected{{0, 0}, {1.0 / 3, 0}, {2.0 / 3, 1.0 / 7}};
  EXPECT_EQ(region.parts().at(0).outer, expected);
  EXPECT_EQ(region.polylines().at(0), (Polyline{{4.0 / 3, 1}, {5.0 / 3, 1}}));
  EXPECT_EQ(region.points().at(0), (Point{-1.0 / 3, -0.1}));
}

TEST_F(RoundingTest, VerticesCloserThanDoublesCollide) {
  part(source->ring({{0, 0}, {1, 0}, {1, 1}, {1 - power_of_two(-70), 1 + power_of_two(-70)}, {0, 1}}));
  expect_error("makes two vertices equal");
  const Evidence evidence = sum.rounded().error().evidence;
  EXPECT_EQ(evidence.part, 0);
  EXPECT_EQ(evidence.ring, 0);
  EXPECT_EQ(std::min(evidence.vertex, evidence.other_vertex), 2);
  EXPECT_EQ(std::max(evidence.vertex, evidence.other_vertex), 3);
  EXPECT_EQ(evidence.x, 1);
  EXPECT_EQ(evidence.y, 1);
  const Repaired repaired = sum.rounded_with_repair().value();
  EXPECT_EQ(repaired.report.duplicate_vertices, 1u);
  EXPECT_EQ(repaired.region.parts().at(0).outer, (Ring{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

TEST_F(RoundingTest, EqualVerticesStayEqual) {
  // two triangles that touch in (1/3, 1/3)
  part(source->ring({{0, 0}, {Q(1, 3), Q(1, 3)}, {0, 1}}));
  part(source->ring({{Q(1, 3), Q(1, 3)}, {1, 0}, {1, 1}}));
  const Region region = sum.rounded().value();
  EXPECT_EQ(region.parts()[0].outer[1], region.parts()[1].outer[0]);
}

// The hole's first vertex lies inside the slanted edge of the outer ring.
TEST_F(RoundingTest, ContactThatWouldOpenBendsTheEdge) {
  int bent = 0, straight = 0;
  for (int den = 2; den <= 40; ++den) {
    SCOPED_TRACE(den);
    sum.parts.clear();
    const Q t(1, den);
    part(source->ring({{0, 0}, {10, 1}, {10, 9}, {0, 9}}), {source->ring({{10 * t, t}, {1, 8}, {8, 8}})});
    const Region region = sum.rounded().value();
    const Point touch = region.parts()[0].holes[0][0];
    const Ring& outer = region.parts()[0].outer;
    if (exact::orient_sign({0, 0}, {10, 1}, touch) == 0) {
      EXPECT_EQ(outer.size(), 4u);
      ++straight;
    } else {
      ASSERT_EQ(outer.size(), 5u);
      EXPECT_EQ(outer[1], touch);
      ++bent;
    }
    EXPECT_FALSE(sum.rounded_with_repair().value().report.changed());
  }
  EXPECT_GE(bent, 10);
  EXPECT_GE(straight, 2);
}

TEST_F(RoundingTest, SeveralContactsBendAnEdgeInTheirOrder) {
  part(source->ring({{0, 0}, {10, 1}, {10, 9}, {0, 9}}),
       {source->ring({{Q(20, 3), Q(2, 3)}, {6, 4}, {7, 4}}), source->ring({{Q(10, 3), Q(1, 3)}, {3, 4}, {4, 4}})});
  segment(Q(10, 7), Q(1, 7), 1, -3);  // an antenna that starts inside the edge
  const Region region = sum.rounded().value();
  const Ring expected{{0, 0}, {10.0 / 7, 1.0 / 7}, {10.0 / 3, 1.0 / 3}, {20.0 / 3, 2.0 / 3}, {10, 1}, {10, 9}, {0, 9}};
  EXPECT_EQ(region.parts()[0].outer, expected);
}

TEST_F(RoundingTest, VertexThatWouldLandOnAnEdgeIsAnError) {
  part(source->ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {source->ring({{2, power_of_two(-1080)}, {1, 2}, {3, 2}})});
  expect_error("moves a vertex onto an edge");
  const Evidence evidence = sum.rounded().error().evidence;
  EXPECT_EQ(evidence.ring, 1);
  EXPECT_EQ(evidence.vertex, 0);
  EXPECT_EQ(evidence.other_ring, 0);
  EXPECT_EQ(evidence.other_vertex, 0);
  EXPECT_TRUE(sum.rounded_with_repair().ok());
}

TEST_F(RoundingTest, RingsThatWouldCrossAreAnError) {
  int crossed = 0;
  for (int den = 3; den <= 40; ++den) {
    SCOPED_TRACE(den);
    sum.parts.clear();
    // above the edge by less than rounding
    const Q t(1, den), x = 10 * t, y = t + power_of_two(-90);
    part(source->ring({{0, 0}, {10, 1}, {10, 9}, {0, 9}}), {source->ring({{x, y}, {1, 8}, {8, 8}})});
    const Point touch{exact::round_to_double(x), exact::round_to_double(y)};
    const int side = exact::orient_sign({0, 0}, {10, 1}, touch);
    if (side > 0) {
      EXPECT_TRUE(sum.rounded().ok());
    } else if (side == 0) {
      expect_error("moves a vertex onto an edge");
    } else {
      ++crossed;
      expect_error("makes an invalid region");
      EXPECT_EQ(sum.rounded_with_repair().error().code, ErrorCode::rounding_changed_topology);
    }
  }
  EXPECT_GE(crossed, 5);
}

TEST_F(RoundingTest, SliverCollapses) {
  part(source->ring({{0, 0}, {1, 0}, {1, 1}}));
  part(source->ring({{2, 0}, {3, 0}, {Q(5, 2), power_of_two(-1100)}}));
  expect_error("");
  const Repaired repaired = sum.rounded_with_repair().value();
  EXPECT_EQ(repaired.report.dropped_rings, 1u);
  EXPECT_EQ(repaired.region.parts().size(), 1u);
}

TEST_F(RoundingTest, SegmentsAndPointsCollapse) {
  segment(Q(1, 3), 0, Q(1, 3) + power_of_two(-90), 0);
  sum.points = {source->add(5, 5), source->add(5 + power_of_two(-90), 5)};
  expect_error("makes two vertices equal");
  const Repaired repaired = sum.rounded_with_repair().value();
  EXPECT_EQ(repaired.report.polylines_to_points, 1u);
  EXPECT_EQ(repaired.report.duplicate_vertices, 2u);  // the point's, and the segment's ends
  EXPECT_TRUE(repaired.region.polylines().empty());
  EXPECT_EQ(repaired.region.points().size(), 2u);
}

TEST_F(RoundingTest, CrossingsOfSegmentsStay) {
  segment(0, 0, 3, 3);
  segment(0, 3, 3, 0);
  segment(0, 1, 3, 1);
  EXPECT_EQ(sum.rounded().value().polylines().size(), 3u);
}

TEST_F(RoundingTest, CrossingOfSegmentsThatWouldOpenIsAnError) {
  int lost = 0;
  for (int den = 3; den <= 40; ++den) {
    SCOPED_TRACE(den);
    sum.segments.clear();
    const Q t(1, den), x = 10 * t, y = t - power_of_two(-90);  // reaches below the other segment by less than rounding
    segment(0, 0, 10, 1);
    segment(x, y, 1, 8);
    const int side = exact::orient_sign({0, 0}, {10, 1}, Point{exact::round_to_double(x), exact::round_to_double(y)});
    if (side < 0) {
      EXPECT_TRUE(sum.rounded().ok());
    } else if (side > 0) {
      ++lost;
      expect_error("makes or loses a crossing");
    }
  }
  EXPECT_GE(lost, 5);
}

TEST_F(RoundingTest, SegmentsCrossingInAVertexOfAThirdStayJoined) {
  segment(0, 0, 10, 1);
  segment(Q(10, 3), 0, Q(10, 3), 1);
  segment(Q(10, 3), Q(1, 3), 4, -2);
  const Region region = sum.rounded().value();
  EXPECT_EQ(region.polylines()[0].size(), 3u);
  EXPECT_EQ(region.polylines()[0][1], (Point{10.0 / 3, 1.0 / 3}));
}

TEST_F(RoundingTest, CoordinatesPastTheDoubleRangeAreAnError) {
  part(source->ring({{0, 0}, {power_of_two(1200), 0}, {0, 1}}));
  expect_error("leaves the range of doubles");
  EXPECT_EQ(sum.rounded_with_repair().error().code, ErrorCode::rounding_changed_topology);
}

TEST_F(RoundingTest, VerticesWithoutASourceAreABrokenContract) {
  part(source->ring({{0, 0}, {1, 0}, {0, 1}}));
  exact_source(sum) = nullptr;
  EXPECT_THROW((void)sum.rounded(), std::logic_error);
}

}  // namespace
}  // namespace dymsum
