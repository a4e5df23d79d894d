// Shapes as people have them: turned by an angle in doubles, so that what would coincide on a grid is 10^-16 apart.
#include <ctime>
#include <map>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

Region squares(int rows) {
  RegionData data;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) data.parts.push_back({box(4 * i, 4 * j, 4 * i + 1, 4 * j + 1), {}});
  return *Region::create(data);
}

std::map<std::pair<bool, std::int64_t>, int> kinds_of_shells(const CspaceObstacle& c) {
  std::map<std::pair<bool, std::int64_t>, int> all;
  for (const Shell& s : c.shells()) ++all[{s.outer, s.euler}];
  return all;
}

void expect_the_obstacle_by_slices(const CspaceObstacle& c) {
  ObstacleOptions options;
  options.reference = true;
  const CspaceObstacle slow = CspaceObstacle::create(c.robot(), c.obstacle(), options).value();
  EXPECT_EQ(kinds_of_shells(c), kinds_of_shells(slow));
  EXPECT_EQ(free_components(c), free_components(slow));
  EXPECT_EQ(c.tight().size(), slow.tight().size());
  EXPECT_EQ(c.patches().size(), slow.patches().size());
  for (std::uint32_t slab = 0; slab < slabs(slow); ++slab)
    if (const std::optional<std::uint32_t> same = c.slab_of(slow.inside(slab))) {
      ASSERT_EQ(of_slab(slow, slab), of_slab(c, *same)) << "slab " << slab;
    }
}

TEST(CspaceTurned, squares_take_no_slices_where_their_sides_are_nearly_aligned) {
  for (const double degrees : {30.0, 17.3}) {
    const CspaceObstacle c = CspaceObstacle::create(polygon(box(0, 0, 3, 0.5)), turned(squares(2), degrees)).value();
    EXPECT_LE(c.work().slices, 4U);  // 160 where doubles alone settled events
    EXPECT_GT(c.work().local_updates, 50U);
    expect_the_obstacle_by_slices(c);
  }
}

// Whole slices made the time grow with the square of how many there are.
TEST(CspaceTurned, more_squares_take_more_updates_and_no_more_slices) {
  for (const int rows : {3, 6}) {
    const CspaceObstacle c = CspaceObstacle::create(polygon(box(0, 0, 3, 0.5)), turned(squares(rows), 30)).value();
    EXPECT_LE(c.work().slices, 6U);
    EXPECT_GT(c.work().local_updates, 20U * static_cast<unsigned>(rows * rows));
  }
}

// Crossings with lines that bear no segment at the angle were taken for tight: 34 of them.
TEST(CspaceTurned, combs_are_the_obstacle_by_slices) {
  for (const double degrees : {0.0, 30.0}) {
    const CspaceObstacle c = CspaceObstacle::create(turned(toothed(2), degrees), turned(toothed(3), degrees)).value();
    expect_the_obstacle_by_slices(c);
    EXPECT_EQ(c.tight().empty(), degrees != 0);
    EXPECT_LE(c.work().slices, 4U);  // 687
    Random random(1);
    expect_slices(c, random, 1000);
  }
}

// Of the triples of lines that coincide but for a rounding nearly all are covered, and none of these becomes an event:
// 8,025 of 25,717 did. Whichever of the two was turned.
TEST(CspaceTurned, lines_that_nearly_coincide_make_few_events) {
  for (const double degrees : {0.0, 30.0}) {
    const CspaceObstacle c = CspaceObstacle::create(turned(toothed(3), 30), turned(toothed(5), 30 + degrees)).value();
    EXPECT_LE(c.work().potential_events, 1500U);
    EXPECT_LE(c.work().candidate_triples, 25000U);
    EXPECT_LE(c.work().slices, 6U);
    EXPECT_GT(c.work().visible_events, 50U);
    Random random(2);
    expect_slices(c, random, 60);
  }
}

// Between two questions whether to go on lies a small part of all work, whatever coincides: a time limit ends it in
// time.
TEST(CspaceTurned, making_it_asks_whether_to_go_on) {
  const Region robot = turned(toothed(3), 30), obstacle = turned(toothed(4), 30);
  std::clock_t last = std::clock(), longest = 0;
  const std::clock_t begin = last;
  ObstacleOptions options;
  options.progress = [&](std::string_view, double) {
    const std::clock_t now = std::clock();
    longest = std::max(longest, now - last);
    last = now;
    return true;
  };
  ASSERT_TRUE(CspaceObstacle::create(robot, obstacle, options).ok());
  EXPECT_LT(longest * 4, std::clock() - begin);
  int left = 10;
  options.progress = [&](std::string_view, double) { return --left > 0; };
  EXPECT_EQ(CspaceObstacle::create(robot, obstacle, options).error().code, ErrorCode::cancelled);
  EXPECT_LE(left, 0);
}

// Small shapes on a grid, most of whose events coincide, as they are and turned: chains in a box around coinciding
// events take the place of whole slices.
TEST(CspaceTurned, coinciding_events_give_the_obstacle_by_slices) {
  std::uint64_t slices = 0, updates = 0;
  for_seeds(12, [&](Random& random) {
    const bool cells = random() % 2 == 0;
    const Region robot = cells ? random_cells(random, 2, 1) : random_shape(random, 2, 4, false);
    const Region obstacle = cells ? random_cells(random, 3, 1) : random_shape(random, 3, 6, random() % 2 == 0, 1);
    for (const double degrees : {0.0, 30.0}) {
      const CspaceObstacle c = CspaceObstacle::create(turned(robot, degrees), turned(obstacle, degrees)).value();
      expect_the_obstacle_by_slices(c);
      slices += c.work().slices;
      updates += c.work().local_updates;
    }
  });
  EXPECT_GT(updates, 10 * slices);
}

}  // namespace
}  // namespace dymsum
