// Repairs of regions by name: each is made where it is allowed, and only then; what was repaired is said with
// positions.
#include <gtest/gtest.h>

#include "dymsum/named_repairs.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

using Kind = RegionRepairKind;

RegionData defect(Kind kind) {
  switch (kind) {
    case Kind::duplicate_vertices:
      return one_ring({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}});
    case Kind::collinear_vertices:
      return one_ring({{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}});
    case Kind::reversed_rings:
      return one_ring({{0, 0}, {0, 4}, {4, 4}, {4, 0}});
    case Kind::empty_rings:
      return {{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}}, {{{7, 7}, {8, 7}}, {}}}, {}, {}};
    case Kind::duplicate_rings:
      return {{{box(0, 0, 9, 9), {reversed(box(1, 1, 2, 2))}}, {box(0, 0, 9, 9), {reversed(box(1, 1, 2, 2))}}}, {}, {}};
    case Kind::short_polylines:
      return {{}, {{{3, 3}, {3, 3}}}, {}};
  }
  return {};
}

TEST(NamedRegionRepairs, each_is_made_where_it_is_allowed_and_only_then) {
  for (const Kind kind : all_region_repairs()) {
    EXPECT_FALSE(Region::create(defect(kind))) << static_cast<int>(kind);
    const Result<LoggedRegion> made = repair(defect(kind), RegionRepairOptions{});
    ASSERT_TRUE(made.ok()) << static_cast<int>(kind) << made.error().to_string();
    EXPECT_TRUE(repair(defect(kind), RegionRepairOptions{made->log.kinds()})) << static_cast<int>(kind);
    EXPECT_FALSE(repair(defect(kind), RegionRepairOptions{{}})) << static_cast<int>(kind);
  }
}

TEST(NamedRegionRepairs, rings_that_are_there_twice_are_dropped) {
  const LoggedRegion parts = repair(defect(Kind::duplicate_rings), RegionRepairOptions{}).value();
  EXPECT_EQ(parts.region.parts().size(), 1u);
  EXPECT_EQ(parts.log.duplicate_rings, 1u);
  EXPECT_EQ(parts.log.marks, (std::vector<RegionRepairMark>{{Kind::duplicate_rings, {0, 0}}}));
  EXPECT_EQ(parts.log.to_string(), "1 ring that was there already dropped");
  // Holes, begun elsewhere and the other way round.
  const Ring hole = reversed(box(1, 1, 2, 2));
  const LoggedRegion holes =
      repair(RegionData{{{box(0, 0, 9, 9), {hole, box(1, 1, 2, 2), {hole[2], hole[3], hole[0], hole[1]}}}}, {}, {}},
             RegionRepairOptions{})
          .value();
  EXPECT_EQ(holes.region.hole_count(), 1u);
  EXPECT_EQ(holes.log.duplicate_rings, 2u);
  EXPECT_EQ(holes.log.counts.reversed_rings, 1u);
  // Parts with one boundary and other holes are two sets, and stay an error with the indices of the data.
  const Result<LoggedRegion> other =
      repair(RegionData{{{{{0, 0}, {0, 0}}, {}}, {box(0, 0, 9, 9), {hole}}, {box(0, 0, 9, 9), {}}}, {}, {}},
             RegionRepairOptions{});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().evidence.part.value_or(0) + other.error().evidence.other_part.value_or(0), 3);
}

TEST(NamedRegionRepairs, the_repair_of_before_drops_no_duplicates) {
  EXPECT_FALSE(repair(defect(Kind::duplicate_rings)));
}

}  // namespace
}  // namespace dymsum::test
