// Limits of memory of obstacles and searches in them.
#include <gtest/gtest.h>

#include <string>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/obstacle_file.h"
#include "dymsum/planner.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

void expect_limit(const Region& robot, const Region& obstacle) {
  const CspaceObstacle free = CspaceObstacle::create(robot, obstacle).value();
  std::uint64_t limit = 1024;
  for (;; limit *= 2) {
    ASSERT_LT(limit, std::uint64_t{1} << 34);
    ObstacleOptions options;
    options.memory = limit;
    const Result<CspaceObstacle> made = CspaceObstacle::create(robot, obstacle, options);
    if (made) {
      EXPECT_EQ(format_obstacle(*made), format_obstacle(free));
      break;
    }
    EXPECT_EQ(made.error().code, ErrorCode::out_of_memory);
    EXPECT_NE(made.error().message.find("the obstacle takes at least "), std::string::npos) << made.error().message;
    EXPECT_NE(made.error().message.find(", the limit is "), std::string::npos) << made.error().message;
  }
  EXPECT_GT(limit, free.patches().size() * sizeof(Patch) / 4);
}

TEST(CspaceMemory, ObstaclesFitOrSayWhatTheyTake) {
  expect_limit(shapes::disc(12, 1), shapes::disc(16, 3));               // convex ones
  expect_limit(shapes::letter_l(3, 2, 0.5), shapes::comb(4, 2, 1, 3));  // others
}

TEST(CspaceMemory, SearchesFitOrSayWhatTheyTake) {
  const Region robot = shapes::rectangle(-1.5, -0.25, 1.5, 0.25);
  RegionData rooms = shapes::rectangle(-10, -10, 10, 10).data();
  rooms.parts[0].holes = {{{-8, -8}, {-8, 8}, {-0.5, 8}, {-0.5, 1}, {0.5, 1}, {0.5, 8}, {8, 8}, {8, -8}}};
  const Region obstacle = Region::create(rooms).value();
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  const Configuration from{-4, 6, 0}, to{4, 6, 2};
  const auto with = [](std::uint64_t limit) {
    PlanOptions options;
    options.memory = limit;
    return options;
  };
  const Plan free = plan(c, from, to).value();
  ASSERT_TRUE(free.found());
  const Result<Plan> refused = plan(c, from, to, with(1000));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_memory);
  EXPECT_NE(refused.error().message.find("the search for a path takes at least "), std::string::npos);
  EXPECT_EQ(direct_plan(robot, obstacle, from, to, with(1000)).error().code, ErrorCode::out_of_memory);
  const Plan same = plan(c, from, to, with(std::uint64_t{1} << 30)).value();
  EXPECT_EQ(same.path.size(), free.path.size());
}

}  // namespace
}  // namespace dymsum
