// Rooms and robots that motions are tested in, and the public checks of one piece of a path.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/motion.h"
#include "dymsum/planner.h"
#include "dymsum/region.h"

namespace dymsum::test_rooms {

inline Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

inline Region region(std::vector<Part> parts) {
  RegionData data;
  data.parts = std::move(parts);
  return repair(std::move(data)).value().region;
}

/// Two rooms of 10 x 10 and a wall between them, 2 thick, with a doorway from y = low to y = high.
inline Region two_rooms(double low, double high) {
  return region({{box(-12, -6, 12, 6),
                  {{{-11, -5},
                    {-11, 5},
                    {-1, 5},
                    {-1, high},
                    {1, high},
                    {1, 5},
                    {11, 5},
                    {11, -5},
                    {1, -5},
                    {1, low},
                    {-1, low},
                    {-1, -5}}}}});
}

/// A room that is left through its mouth, twice as high as `mouth`, past the walls of a funnel.
inline Region bug_trap(double mouth) {
  return region({{{{-5, -5},
                   {5, -5},
                   {5, 5},
                   {-5, 5},
                   {-5, mouth},
                   {0, mouth},
                   {0, mouth + 0.5},
                   {-4, mouth + 0.5},
                   {-4, 4},
                   {4, 4},
                   {4, -4},
                   {-4, -4},
                   {-4, -mouth - 0.5},
                   {0, -mouth - 0.5},
                   {0, -mouth},
                   {-5, -mouth}},
                  {}}});
}

/// What repair makes of up to `most` random points of a grid; it touches itself nowhere.
inline Region random_shape(std::mt19937_64& random, int reach, int most, double scale = 1) {
  const auto at = [&] { return scale * (static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach); };
  for (;;) {
    RegionData data;
    data.parts.emplace_back();
    const int n = 3 + static_cast<int>(random() % static_cast<unsigned>(most - 2));
    for (int i = 0; i < n; ++i) data.parts[0].outer.push_back({at(), at()});
    Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.empty() && repaired->region.touching_points().empty())
      return repaired->region;
  }
}

/// The piece of a path that ends at waypoint k > 0 by the exact checks.
inline void expect_free_piece(const CspaceObstacle& c, const Plan& p, std::size_t k, Touching touching) {
  const Waypoint &a = p.path[k - 1], &b = p.path[k];
  if (b.move == Waypoint::Move::translation) {
    ASSERT_EQ(a.theta, b.theta);
    ASSERT_TRUE(check_translation(c.robot(), c.obstacle(), a.at, b.at, a.theta, touching)->free) << k;
  } else {
    ASSERT_EQ(a.at, b.at);
    const auto d = b.move == Waypoint::Move::clockwise ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
    ASSERT_TRUE(check_rotation(c.robot(), c.obstacle(), a.at, a.theta, b.theta, d, touching)->free) << k;
  }
}

}  // namespace dymsum::test_rooms
