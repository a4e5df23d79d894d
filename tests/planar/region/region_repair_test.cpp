// What repair repairs, what it reports, and what it leaves to be refused.
#include <gtest/gtest.h>

#include <limits>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

RepairReport report(std::size_t duplicates, std::size_t collinear, std::size_t reversed_rings, std::size_t dropped,
                    std::size_t points = 0) {
  RepairReport r;
  r.duplicate_vertices = duplicates;
  r.collinear_vertices = collinear;
  r.reversed_rings = reversed_rings;
  r.dropped_rings = dropped;
  r.polylines_to_points = points;
  return r;
}

void expect_repaired(RegionData data, const RegionData& repaired, const RepairReport& expected) {
  const Result<Repaired> result = repair(std::move(data));
  ASSERT_TRUE(result.ok()) << result.error().to_string();
  EXPECT_EQ(result->region.data(), repaired);
  EXPECT_EQ(result->report.to_string(), expected.to_string());
  EXPECT_EQ(result->report.changed(), expected.changed());
}

TEST(RegionRepair, AValidRegionWithoutStraightVerticesStaysAsItIs) {
  const RegionData data{{{box(0, 0, 9, 9), {reversed(box(2, 2, 3, 3))}}}, {{{0, 0}, {1, 1}, {2, 0}}}, {{5, 5}, {5, 5}}};
  expect_repaired(data, data, report(0, 0, 0, 0));
  EXPECT_EQ(repair(data)->report.to_string(), "nothing to repair");
  EXPECT_FALSE(repair(data)->report.changed());
}

TEST(RegionRepair, DuplicateVerticesAndTheClosingOne) {
  expect_repaired(one_ring({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}}), one_ring(box(0, 0, 1, 1)),
                  report(4, 0, 0, 0));
}

TEST(RegionRepair, CollinearVerticesAlsoAtTheSeam) {
  expect_repaired(one_ring({{1, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}),
                  one_ring({{4, 0}, {4, 4}, {0, 4}, {0, 0}}), report(0, 2, 0, 0));
}

TEST(RegionRepair, SpikesOfEveryKind) {
  // Out and back to the same vertex; out and back past it; a spike of a spike; a spike at the seam.
  expect_repaired(one_ring({{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}}), one_ring(box(0, 0, 4, 4)),
                  report(0, 2, 0, 0));
  expect_repaired(one_ring({{0, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}}), one_ring(box(0, 0, 4, 4)), report(0, 1, 0, 0));
  expect_repaired(one_ring({{0, 0}, {4, 0}, {6, 0}, {7, 7}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}), one_ring(box(0, 0, 4, 4)),
                  report(1, 3, 0, 0));
  expect_repaired(one_ring({{-3, -3}, {0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}), one_ring(box(0, 0, 4, 4)),
                  report(1, 1, 0, 0));
}

TEST(RegionRepair, OrientationOfOuterRingsAndHoles) {
  expect_repaired(with_holes(reversed(box(0, 0, 9, 9)), {box(2, 2, 3, 3), reversed(box(5, 5, 6, 6))}),
                  with_holes(box(0, 0, 9, 9), {reversed(box(2, 2, 3, 3)), reversed(box(5, 5, 6, 6))}),
                  report(0, 0, 2, 0));
  const Ring fan = {{0, 0}, {2, -2}, {2, -1}, {0, 0}, {2, 1}, {2, 2}};
  expect_repaired(one_ring(reversed(fan)), one_ring(fan), report(0, 0, 1, 0));
  expect_repaired(one_ring(fan), one_ring(fan), report(0, 0, 0, 0));
}

TEST(RegionRepair, RingsThatEncloseNothingAreDropped) {
  const Part nothing_in_nothing{{{0, 0}, {5, 5}, {2, 2}}, {{{1, 1}, {1, 1}}}};
  const Part empty_holes{box(0, 0, 4, 4), {{{1, 1}, {2, 2}, {3, 3}}, {}}};
  const RegionData data{{nothing_in_nothing, empty_holes}, {}, {}};
  const Result<Repaired> result = repair(data);
  ASSERT_TRUE(result.ok()) << result.error().to_string();
  EXPECT_EQ(result->region.data(), one_ring(box(0, 0, 4, 4)));
  EXPECT_EQ(result->report.dropped_rings, 4u);
  // A tree walked all the way around.
  const Ring tree = {{0, 0}, {4, 0}, {4, 2}, {4, 0}, {8, 0}, {9, 3}, {8, 0}, {4, 0}};
  const Result<Repaired> nothing = repair(one_ring(tree));
  ASSERT_TRUE(nothing.ok());
  EXPECT_TRUE(nothing->region.empty());
  EXPECT_EQ(nothing->report.dropped_rings, 1u);
}

TEST(RegionRepair, AHoleLeftWithoutItsOuterRingIsAnError) {
  const Result<Repaired> result = repair(with_holes({{0, 0}, {5, 5}}, {box(1, 1, 2, 2)}));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::hole_outside);
  EXPECT_EQ(result.error().evidence.part, 0);
  EXPECT_EQ(result.error().evidence.ring, 1);
}

TEST(RegionRepair, Polylines) {
  const Polyline folded = {{0, 0}, {0, 0}, {1, 1}, {2, 2}, {5, 5}, {3, 3}, {3, 3}};
  expect_repaired({{}, {folded, {{7, 7}, {7, 7}}, {{8, 8}}}, {{1, 0}}},
                  {{}, {{{0, 0}, {5, 5}, {3, 3}}}, {{1, 0}, {7, 7}, {8, 8}}}, report(3, 2, 0, 0, 2));
  const Result<Repaired> result = repair({{}, {{{8, 8}}, {}}, {}});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::too_few_vertices);
  EXPECT_EQ(result.error().evidence.ring, 1);
}

TEST(RegionRepair, ReportInWords) {
  EXPECT_EQ(report(1, 2, 1, 3, 1).to_string(),
            "1 duplicate vertex merged, 2 collinear vertices dropped, 1 ring reversed, 3 empty rings dropped, "
            "1 polyline collapsed to a point");
  EXPECT_TRUE(report(0, 0, 0, 0, 1).changed());
}

TEST(RegionRepair, NotFiniteIsAnErrorBeforeAnythingElse) {
  const Result<Repaired> result = repair(one_ring({{0, 0}, {0, 0}, {std::numeric_limits<double>::infinity(), 1}}));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::not_finite);
  EXPECT_EQ(result.error().evidence.vertex, 2);
}

TEST(RegionRepair, ErrorsNameTheGivenIndices) {
  // Part 0 disappears, ring 1 of part 1 too; in ring 2 vertices 0 and 1 are one. Edges 1 and 3 of what is left cross.
  const Ring flat = {{0, 0}, {1, 1}, {2, 2}};
  const Ring bow_tie = {{20, 20}, {20, 20}, {22, 22}, {22, 20}, {20, 22}};
  const RegionData data{{{flat, {}}, {box(0, 0, 90, 90), {flat, bow_tie}}}, {}, {}};
  const Result<Repaired> result = repair(data);
  ASSERT_FALSE(result.ok());
  const Evidence& e = result.error().evidence;
  EXPECT_EQ(result.error().code, ErrorCode::self_crossing);
  EXPECT_EQ(e.part, 1);
  EXPECT_EQ(e.ring, 2);
  EXPECT_EQ(e.other_part, 1);
  EXPECT_EQ(e.other_ring, 2);
  EXPECT_EQ(e.x, 21);
  EXPECT_EQ(e.y, 21);
  // The ring was reversed, so that its edges start where they ended.
  EXPECT_EQ(e.vertex, 4);
  EXPECT_EQ(e.other_vertex, 2);
}

}  // namespace
}  // namespace dymsum::test
