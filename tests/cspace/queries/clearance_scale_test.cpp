// Clearances and containment at the ends of the range of doubles, and where turning costs nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

using testing_obstacles::box;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Region shape(Ring outer, std::vector<Ring> holes = {}) {
  return Region::create({{{std::move(outer), std::move(holes)}}, {}, {}}).value();
}

std::vector<std::pair<Region, Region>> scenes() {
  const Ring hole{{-4, -4}, {-4, 6}, {8, 6}, {8, 1}, {2, 1}, {2, -1}, {8, -1}, {8, -4}};
  return {{shape(box(-1, -0.25, 1, 0.25)), shape(box(-5, -5, 9, 7), {hole})},
          {shape(box(0, 0, 1, 1)), shape(box(-1, -1, 2, 2), {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}})},
          {shape({{0, 0}, {3, 1}, {4, 4}, {1, 3}}), shape({{0, 0}, {5, 0}, {0, 1}})}};
}

std::vector<Configuration> questions(std::mt19937_64& random) {
  std::vector<Configuration> all{{0, 0, 0}, {0, 0, 0.5}, {1, 1, 0}};
  std::uniform_real_distribution<double> at(-9, 11), angle(-4, 4);
  for (int k = 0; k < 12; ++k) all.push_back({at(random), at(random), angle(random)});
  return all;
}

TEST(ClearanceScale, tiny_scenes_are_those_of_their_size) {
  std::mt19937_64 random(1);
  for (const auto& [robot, obstacle] : scenes()) {
    const CspaceObstacle whole_obstacle = CspaceObstacle::create(robot, obstacle).value();
    const ObstacleQueries whole(whole_obstacle);
    const std::vector<Configuration> queried = questions(random);
    for (const int exponent : {-300, -530, -600, -1000}) {
      SCOPED_TRACE(exponent);
      const double s = std::ldexp(1.0, exponent);
      const CspaceObstacle tiny_obstacle =
          CspaceObstacle::create(*scaled(robot, s, s), *scaled(obstacle, s, s)).value();
      const ObstacleQueries tiny(tiny_obstacle);
      EXPECT_EQ(tiny.largest_weight(), s * whole.largest_weight());
      for (const Configuration& q : queried) {
        const Configuration at{s * q.x, s * q.y, q.theta};
        EXPECT_EQ(tiny.contains(at), whole.contains(q));
        for (const double weight : {0.0, 0.01, 1.0, kInfinity})
          for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
            const Clearance a = whole.clearance(q, weight, touching), b = tiny.clearance(at, s * weight, touching);
            EXPECT_NEAR(b.distance / s, a.distance, a.error + b.error / s) << q.x << ' ' << q.y << ' ' << weight;
            EXPECT_LE(b.error / s, 4 * a.error + 1e-12);
            EXPECT_EQ(std::signbit(b.distance), std::signbit(a.distance));
          }
        const std::vector<FreeAngles> a = whole.free_angles(q.x, q.y), b = tiny.free_angles(at.x, at.y);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k)
          EXPECT_NEAR(a[k].begin, b[k].begin, a[k].begin_error + b[k].begin_error);
      }
    }
  }
}

// All of the obstacle is then at one distance.
TEST(ClearanceScale, of_what_is_very_far_away) {
  for (const auto& [robot, obstacle] : scenes())
    for (const double s : {1.0, 0x1p-900}) {
      const CspaceObstacle c = CspaceObstacle::create(*scaled(robot, s, s), *scaled(obstacle, s, s)).value();
      const ObstacleQueries queries(c);
      for (const double far : {0x1p190, 0x1p210, 0x1p400, 0x1p900})
        for (const double weight : {0.0, 1.0, 1e12, kInfinity}) {
          const Clearance found = queries.clearance({3 * far * s, -4 * far * s, 1}, s * weight);
          EXPECT_NEAR(found.distance, 5 * far * s, found.error);
          EXPECT_LE(found.error, 0x1p-40 * far * s);
          EXPECT_LE(std::hypot(found.nearest.x, found.nearest.y), 100 * s);
        }
    }
}

// A free robot that can turn into the obstacle touches it at some angle: what is nearest by translation alone is that
// contact, and not a position at which it overlaps.
TEST(ClearanceScale, without_weight_the_nearest_place_is_boundary) {
  std::mt19937_64 random(2);
  int touched = 0;
  for (const auto& [robot, obstacle] : scenes()) {
    const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
    const ObstacleQueries queries(c);
    for (int round = 0; round < 10; ++round)
      for (const Configuration& q : questions(random))
        for (const double weight : {0.0, 1e-300, 1e-13}) {
          const Clearance found = queries.clearance(q, weight);
          if (found.distance < 0) continue;
          touched += found.distance <= found.error;
          EXPECT_LE(std::abs(queries.clearance(found.nearest, kInfinity).distance), 1e-10)
              << q.x << ' ' << q.y << ' ' << q.theta << ": " << found.nearest.theta;
        }
  }
  EXPECT_GT(touched, 50);
}

// Another edge of the robot passes through the same position half a turn on, inside the obstacle.
TEST(ClearanceScale, without_weight_an_angle_half_a_turn_away_is_no_contact) {
  const double w = 1.888225473525463, h = 0.21291764897122414;
  const Region robot = shape({{0, 0}, {w, 0}, {w, h}, {h, h}, {h, w}, {0, w}});
  RegionData pillars;
  for (const Ring& pillar : {box(0.9498533599997996, 4.603941314961466, 2.455756413577909, 7.751165467868008),
                             box(5.447341734749303, 1.669486382666281, 7.251412860893657, 5.562315345248521),
                             box(9.17630453811813, -4.23526291647349, 11.006759604702383, -3.053149347217608),
                             box(12.63883475249602, -4.95084190236525, 13.356855199135152, -0.39735214319889867)})
    pillars.parts.push_back({pillar, {}});
  const CspaceObstacle c = CspaceObstacle::create(robot, Region::create(pillars).value()).value();
  const ObstacleQueries queries(c);
  const Clearance found = queries.clearance({14.362782022863392, -4.5403769498025905, -1.2002310415352646}, 0);
  EXPECT_LE(found.distance, found.error);
  EXPECT_LE(std::abs(queries.clearance(found.nearest, kInfinity).distance), 1e-11) << found.nearest.theta;
}

}  // namespace
}  // namespace dymsum
