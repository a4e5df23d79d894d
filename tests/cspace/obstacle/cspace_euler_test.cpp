// Euler numbers of shells. A shell bounds free space made smaller by a trifle, so they are those of a robot that is
// grown by a trifle, to which the same rooms and passages remain but where nothing touches at one angle only.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/planar_sum.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

CspaceObstacle obstacle_of(const Region& robot, const Region& obstacle, bool reference = false) {
  ObstacleOptions options;
  options.reference = reference;
  return CspaceObstacle::create(robot, obstacle, options).value();
}

// Of shells, those that bound cavities last.
using Numbers = std::vector<std::pair<bool, std::int64_t>>;
Numbers euler_numbers(const CspaceObstacle& c) {
  Numbers all;
  for (const Shell& shell : c.shells()) all.emplace_back(!shell.outer, shell.euler);
  std::sort(all.begin(), all.end());
  return all;
}

Region grown(const Region& robot, double hair) {
  const Region triangle = polygon({{3 * hair, hair}, {-2 * hair, 2 * hair}, {-hair, -3 * hair}});
  return minkowski_sum(robot, triangle).value().rounded().value();
}

// Of the robot, of the same by whole slices only, and of one that is larger by a hair.
void expect_euler_of_grown(const Region& robot, const Region& obstacle, double hair = 0x1p-20) {
  const CspaceObstacle c = obstacle_of(robot, obstacle), g = obstacle_of(grown(robot, hair), obstacle);
  EXPECT_EQ(euler_numbers(c), euler_numbers(obstacle_of(robot, obstacle, true)));
  EXPECT_EQ(euler_numbers(c), euler_numbers(g))
      << c.work().slices << " whole slices, of the grown robot " << g.work().slices << "\nrobot "
      << format_region(robot, RegionFormat::wkt) << "\nobstacle " << format_region(obstacle, RegionFormat::wkt);
  EXPECT_EQ(free_components(c), free_components(g));
}

// Two rooms and a corridor in which the rhombus cannot stand upright: in either room it turns all round, and there is a
// passage for either half turn. Three handles.
TEST(CspaceEuler, of_two_rooms_and_a_corridor_that_is_shut_at_one_angle) {
  const Ring rooms{{-20, -5}, {-10, -5}, {-10, -2}, {10, -2}, {10, -5}, {20, -5},
                   {20, 5},   {10, 5},   {10, 2},   {-10, 2}, {-10, 5}, {-20, 5}};
  const Region rhombus = polygon({{2, 0}, {0, 1}, {-2, 0}, {0, -1}}),
               dumbbell = polygon(box(-40, -40, 40, 40), {reversed(rooms)});
  EXPECT_EQ(euler_numbers(obstacle_of(rhombus, dumbbell)), (Numbers{{false, 0}, {true, -4}}));
  expect_euler_of_grown(rhombus, dumbbell);
}

// A gap over an island, as high as the rhombus is long: no loop is born, vanishes, splits or joins another one, but
// upright its walls touch all along. So the wall of the room and that of the island are one surface.
TEST(CspaceEuler, of_walls_that_touch_along_a_stretch_at_one_angle) {
  const Region rhombus = polygon({{2, 0}, {0, 1}, {-2, 0}, {0, -1}});
  const auto island = [](double gap) {
    RegionData data;
    data.parts.push_back({box(-60, -60, 60, 60), {reversed(box(-20, -20, 20, gap))}});
    data.parts.push_back({box(-3, -5, 3, 0), {}});
    return *Region::create(data);
  };
  EXPECT_EQ(euler_numbers(obstacle_of(rhombus, island(4))), (Numbers{{false, 0}, {true, -4}}));
  EXPECT_EQ(euler_numbers(obstacle_of(rhombus, island(4.125))), (Numbers{{false, 0}, {true, 0}, {true, 0}}));
  expect_euler_of_grown(rhombus, island(4));
}

TEST(CspaceEuler, of_robots_in_rooms_of_squares) {
  for_seeds(30, [](Random& random) {
    RegionData data;
    data.parts.push_back({box(-40, -40, 40, 40), {}});
    const Region robot = random_cells(random, 2, 1),
                 room = random_cells(random, 4, 1 + static_cast<double>(random() % 3) / 2);
    for (const Part& part : room.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    expect_euler_of_grown(robot, *Region::create(data));
  });
}

TEST(CspaceEuler, of_boards_that_touch_themselves) {
  for_seeds(15, [](Random& random) {
    const Region robot = random() % 2 == 0 ? random_board(random, 3, 1) : random_cells(random, 2, 1);
    expect_euler_of_grown(robot, random_board(random, 4, 1 + static_cast<double>(random() % 3) / 2));
  });
}

TEST(CspaceEuler, of_small_integer_shapes) {
  for_seeds(50, [](Random& random) {
    const Region robot = random_shape(random, 3, 5, false, 1 + static_cast<int>(random() % 2));
    expect_euler_of_grown(robot, random_shape(random, 6, 7, random() % 2 == 0, 1 + static_cast<int>(random() % 2)));
  });
}

}  // namespace
}  // namespace dymsum
