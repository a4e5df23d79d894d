// Joints of a mesh's layers where edges are aligned: all crossings go on.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cspace/mesh/obstacle_rails.h"
#include "oracles/random.h"

namespace dymsum::cspace {
namespace {

Region star_with(const std::vector<Point>& ring) {
  RegionData data;
  data.parts.push_back({ring, {}});
  return Region::create(std::move(data)).value();
}

// At small angles, which are known to less than what products are rounded by.
TEST(AlignedJoints, go_on_at_angles_that_are_hardly_rounded) {
  oracles::Random random(78);
  int crossings = 0;
  for (int k = 0; k < 40; ++k) {
    std::vector<Point> robot, turned;
    const double by = std::ldexp(random.signed_unit(), -5), c = std::cos(by), s = std::sin(by);
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.7854 * (i + 0.3 * random.signed_unit()),
                   r = (i % 2 == 0 ? 1 : 0.4) * (1 + 0.2 * random.signed_unit()), grow = 1 + 0.2 * random.signed_unit();
      const Point v{r * std::cos(angle), r * std::sin(angle)};
      robot.push_back(v);
      turned.push_back({grow * (-c * v.x + s * v.y), grow * (-s * v.x - c * v.y)});
    }
    const CspaceObstacle obstacle = CspaceObstacle::create(star_with(robot), star_with(turned)).value();
    std::map<std::uint32_t, int> events, aligned;
    for (const ObstacleEvent& e : obstacle.events()) {
      ++events[e.angle];
      aligned[e.angle] += e.kind == ObstacleEvent::Kind::alignment;
    }
    const ObstacleLayout layout = lay_out(obstacle);
    for (const auto& [angle, count] : events) {
      if (count != 1 || aligned[angle] != 1) continue;
      const Station& station = layout.stations[angle];
      const auto expect_more = [&](const std::vector<std::uint32_t>& pieces, auto next) {
        for (const std::uint32_t p : pieces) {
          const Patch& patch = obstacle.patches()[layout.pieces[p].patch];
          for (const std::size_t side : {0u, 1u}) {
            if (side == 0 ? patch.left_corner : patch.right_corner) continue;
            EXPECT_NE(next(layout.pieces[p].joint[side]), kNobody) << k << " at " << station.theta;
            ++crossings;
          }
        }
      };
      expect_more(station.ending, [&](std::uint32_t joint) { return layout.above(station, joint); });
      expect_more(station.beginning, [&](std::uint32_t joint) { return layout.below(station, joint); });
    }
  }
  EXPECT_GT(crossings, 400);
}

}  // namespace
}  // namespace dymsum::cspace
