// Fast answers against the exact test, against dense sampling of all patches, and against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/shapes.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using testing_obstacles::polygon;
using testing_obstacles::Random;

double uniform_between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Region moved(const Region& region, double dx, double dy) { return *translated(region, dx, dy); }

// Pairs with edges in general directions, in common directions, far from the origin, with turning radii of all kinds,
// with reflex vertices, with holes, and with rings that touch at vertices and on edges.
std::vector<std::pair<Region, Region>> pairs() {
  const Region box = shapes::rectangle(-1, -1, 1, 1), bar = shapes::rectangle(-4, -0.5, 4, 0.5);
  const Region kite = polygon({{0, 0}, {3, 1}, {4, 4}, {1, 3}}), wedge = polygon({{0, 0}, {5, 0}, {0, 1}});
  RegionData parts, holed;
  parts.parts = {{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}}, {{{2, 2}, {5, 2}, {5, 5}, {2, 5}}, {}}};
  holed.parts = {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{{4, 0}, {1, 4}, {4, 7}, {6, 4}}}}};
  const Region two_squares = *Region::create(parts), hole_at_an_edge = *Region::create(holed);
  return {{box, box},
          {bar, snapped_shapes::disc(32, 2)},
          {kite, wedge},
          {wedge, moved(kite, 1000, -777)},
          {moved(box, 5, 0), wedge},
          {kite, kite},
          {shapes::letter_l(3, 2, 0.5), shapes::letter_u(4, 3, 0.75)},
          {shapes::rectangle(-0.4, -0.1, 0.4, 0.1), shapes::grate(3, 2, 0.5, 3)},
          {polygon({{0, 0}, {2, -1}, {1, 0}, {2, 1}}), polygon({{0, 0}, {4, 0}, {5, 4}, {2, 1}, {0, 3}})},
          {wedge, two_squares},
          {moved(two_squares, -2, -1), kite},
          {box, hole_at_an_edge}};
}

// The extent of the obstacle around its midpoint, and the midpoint.
struct Frame {
  double x = 0, y = 0, size = 0;
};
Frame frame(const CspaceObstacle& c) {
  const auto [x0, y0, x1, y1] = bounds(c.obstacle());
  const auto [u0, v0, u1, v1] = bounds(c.robot());
  const double reach = std::hypot(std::max(std::abs(u0), std::abs(u1)), std::max(std::abs(v0), std::abs(v1)));
  return {(x0 + x1) / 2, (y0 + y1) / 2, std::max(x1 - x0, y1 - y0) / 2 + reach};
}

Configuration anywhere(const CspaceObstacle& c, Random& random) {
  const Frame f = frame(c);
  return {f.x + uniform_between(random, -1.2, 1.2) * f.size, f.y + uniform_between(random, -1.2, 1.2) * f.size,
          uniform_between(random, -M_PI, M_PI)};
}

CspaceObstacle make(const std::pair<Region, Region>& pair) {
  return CspaceObstacle::create(pair.first, pair.second).value();
}

TEST(ObstacleQueries, contains_equals_the_exact_test_anywhere) {
  Random random(1);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    int inside = 0;
    for (int k = 0; k < oracles::rounds(1000); ++k) {
      const Configuration at = anywhere(c, random);
      const bool expected = c.contains(at.x, at.y, *Orientation::nearest(at.theta));
      EXPECT_EQ(q.contains(at), expected);
      inside += expected;
    }
    EXPECT_GT(inside, oracles::rounds(20));
    EXPECT_LE(q.exact_answers(), 2u);
  }
}

TEST(ObstacleQueries, contains_equals_the_exact_test_on_the_boundary) {
  Random random(2);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    // Points of patches, rounded: some of them inside, some not; and grid points at quarter turns, many exactly on it.
    for (std::uint32_t p = 0; p < c.patches().size(); p += 3) {
      const Patch& patch = c.patches()[p];
      const double theta = c.angles()[patch.begin].theta + 1e-4, fraction = uniform_between(random, 0, 1);
      const auto [a, b] = c.ends(patch, theta);
      const Configuration at{a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y), theta};
      EXPECT_EQ(q.contains(at), c.contains(at.x, at.y, *Orientation::nearest(theta)));
    }
    EXPECT_GT(q.exact_answers(), 5u);
    const Frame f = frame(c);
    for (int k = 0; k < 300; ++k) {
      const Orientation o =
          random() % 5 == 0 ? Orientation::half_turn() : *Orientation::of(static_cast<int>(random() % 3) - 1, 1);
      const double x = std::round(f.x + uniform_between(random, -1, 1) * f.size);
      const double y = std::round(f.y + uniform_between(random, -1, 1) * f.size);
      EXPECT_EQ(q.contains(x, y, o), c.contains(x, y, o));
    }
  }
}

TEST(ObstacleQueries, contains_many_equals_contains_one) {
  Random random(3);
  const CspaceObstacle c = make(pairs()[2]);
  const ObstacleQueries q(c);
  std::vector<Configuration> many;
  for (int k = 0; k < 5000; ++k) many.push_back(anywhere(c, random));
  for (const int threads : {0, 1, 2}) {
    const std::vector<std::uint8_t> all = q.contains(many, threads);
    ASSERT_EQ(all.size(), many.size());
    for (std::size_t k = 0; k < many.size(); ++k) EXPECT_EQ(all[k] != 0, q.contains(many[k]));
  }
  EXPECT_TRUE(q.contains(std::span<const Configuration>{}).empty());
}

TEST(ObstacleQueries, angles_outside_the_circle_and_no_numbers) {
  const CspaceObstacle c = make(pairs()[2]);
  const ObstacleQueries q(c);
  Random random(4);
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 300; ++k) {
    Configuration at = anywhere(c, random);
    at.theta += 2 * M_PI * (static_cast<int>(random() % 7) - 3);
    EXPECT_EQ(q.contains(at), c.contains(at.x, at.y, *Orientation::nearest(at.theta)));
    EXPECT_EQ(std::signbit(q.clearance(at).distance), q.contains(at));
  }
  for (const double bad : {infinity, -infinity, nan}) {
    EXPECT_FALSE(q.contains({bad, 0, 0}));
    EXPECT_FALSE(q.contains({0, bad, 0}));
    EXPECT_THROW(q.contains({0, 0, bad}), std::invalid_argument);
    EXPECT_THROW(q.clearance({bad, 0, 0}), std::invalid_argument);
    EXPECT_THROW(q.free_angles(bad, 0), std::invalid_argument);
    EXPECT_THROW(q.free_angles(0, bad), std::invalid_argument);
    EXPECT_THROW(q.clearance({0, 0, bad}), std::invalid_argument);
  }
  EXPECT_THROW(q.clearance({}, -1), std::invalid_argument);
  EXPECT_THROW(q.clearance({}, nan), std::invalid_argument);
}

// The least distance among dense samples of all patches.
double sampled(const CspaceObstacle& c, const Configuration& from, double weight, int samples) {
  double best = std::numeric_limits<double>::infinity();
  for (const Patch& p : c.patches()) {
    const double begin = c.angles()[p.begin].theta;
    double end = c.angles()[p.end].theta;
    if (end <= begin) end += 2 * M_PI;
    for (int k = 0; k <= samples; ++k) {
      const double theta = begin + (end - begin) * k / samples, turn = std::remainder(theta - from.theta, 2 * M_PI);
      const auto [a, b] = c.ends(p, theta);
      const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
      const double t = length > 0 ? std::clamp(((from.x - a.x) * dx + (from.y - a.y) * dy) / length, 0.0, 1.0) : 0.0;
      best = std::min(best, std::hypot(a.x + t * dx - from.x, a.y + t * dy - from.y, weight * turn));
    }
  }
  return best;
}

// The point lies on the patch and at the distance that is told.
void expect_witness(const CspaceObstacle& c, const Configuration& from, const Clearance& found, double weight) {
  const Patch& p = c.patches()[found.patch];
  const auto [a, b] = c.ends(p, found.nearest.theta);
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy, size = frame(c).size + std::abs(from.x);
  const double t =
      length > 0 ? std::clamp(((found.nearest.x - a.x) * dx + (found.nearest.y - a.y) * dy) / length, 0.0, 1.0) : 0.0;
  EXPECT_LT(std::hypot(a.x + t * dx - found.nearest.x, a.y + t * dy - found.nearest.y), 1e-11 * size);
  const double turn = std::remainder(found.nearest.theta - from.theta, 2 * M_PI);
  const double angle = std::isinf(weight) ? 0 : weight * turn;
  EXPECT_NEAR(std::hypot(found.nearest.x - from.x, found.nearest.y - from.y, angle), std::abs(found.distance),
              1e-11 * size);
  if (std::isinf(weight)) {
    EXPECT_NEAR(turn, 0, 1e-13);
  }
}

TEST(ObstacleQueries, clearance_is_the_least_distance_to_all_patches) {
  Random random(5);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    const double size = frame(c).size;
    for (int k = 0; k < oracles::rounds(30, 3); ++k) {
      const Configuration from = anywhere(c, random);
      for (const double weight : {q.gyration_radius(), 0.1, 10.0, 0.0}) {
        SCOPED_TRACE(testing::Message() << from.x << " " << from.y << " " << from.theta << " weight " << weight);
        const Clearance found = q.clearance(from, weight);
        EXPECT_LE(found.error, 2e-9 * std::abs(found.distance) + 1e-10 * size);
        const double samples = sampled(c, from, weight, 200);
        EXPECT_LE(std::abs(found.distance), samples + found.error);
        EXPECT_GE(std::abs(found.distance), samples - 8e-3 * (size + weight));
        EXPECT_EQ(std::signbit(found.distance), q.contains(from));
        expect_witness(c, from, found, weight);
      }
    }
  }
}

// To the boundary of the exact slice at the angle.
double slice_distance(const CspaceObstacle& c, const Configuration& from) {
  const PlanarSum slice = *c.slice(*Orientation::nearest(from.theta));
  double least = std::numeric_limits<double>::infinity();
  const auto add = [&](const SumRing& ring) {
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
      const Point a = ring.vertices[i].at, b = ring.vertices[(i + 1) % ring.vertices.size()].at;
      const double dx = b.x - a.x, dy = b.y - a.y;
      const double t = std::clamp(((from.x - a.x) * dx + (from.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      least = std::min(least, std::hypot(a.x + t * dx - from.x, a.y + t * dy - from.y));
    }
  };
  for (const SumPart& part : slice.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return least;
}

TEST(ObstacleQueries, clearance_for_translations_is_that_of_the_slice) {
  Random random(6);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    for (int k = 0; k < 40; ++k) {
      Configuration from = anywhere(c, random);
      if (k % 4 == 0) from.theta = c.angles()[random() % c.angles().size()].theta;
      const double expected = slice_distance(c, from);
      const Clearance found = q.clearance(from, infinity);
      EXPECT_NEAR(std::abs(found.distance), expected, 1e-11 * (frame(c).size + std::abs(frame(c).x)));
      EXPECT_EQ(std::signbit(found.distance), q.contains(from));
      expect_witness(c, from, found, infinity);
      EXPECT_LE(std::abs(q.clearance(from).distance), std::abs(found.distance) + found.error + 1e-9 * frame(c).size);
    }
  }
}

TEST(ObstacleQueries, clearance_moves_with_the_obstacle) {
  Random random(7);
  const auto pair = pairs()[2];
  const CspaceObstacle c = make(pair), d = make({pair.first, moved(pair.second, 64, -32)});
  const ObstacleQueries q(c), r(d);
  for (int k = 0; k < 200; ++k) {
    const Configuration from = anywhere(c, random);
    const Clearance a = q.clearance(from), b = r.clearance({from.x + 64, from.y - 32, from.theta});
    EXPECT_NEAR(a.distance, b.distance, a.error + b.error + 1e-12);
  }
}

TEST(ObstacleQueries, clearance_knows_that_the_circle_closes) {
  // At -pi + e and pi - e the slices are nearly the same: clearances too.
  Random random(8);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    for (int k = 0; k < 100; ++k) {
      Configuration from = anywhere(c, random);
      const double e = uniform_between(random, 0, 1e-7), w = q.gyration_radius();
      from.theta = M_PI - e;
      const Clearance a = q.clearance(from);
      from.theta = -M_PI + e;
      const Clearance b = q.clearance(from);
      EXPECT_NEAR(a.distance, b.distance, 2.1 * e * w + a.error + b.error);
    }
  }
}

TEST(ObstacleQueries, clearance_half_a_turn_away_counts_either_way_round) {
  // A kite in a thick frame whose cavity is a little larger and lies half a turn from it.
  const Region kite = polygon({{-1, -0.5}, {3, 0}, {-1, 0.5}});
  RegionData frame_data;
  frame_data.parts = {{{{-60, -60}, {60, -60}, {60, 60}, {-60, 60}}, {{{1.02, -0.51}, {-3.04, 0}, {1.02, 0.51}}}}};
  const CspaceObstacle c = make({kite, *Region::create(std::move(frame_data))});
  const ObstacleQueries q(c);
  for (const double theta : {0.03, 0.001, 0.0, -0.001, -0.03}) {
    const Configuration from{0.001, 0.0002, theta};
    const Clearance found = q.clearance(from, 0.5);
    EXPECT_LT(found.distance, 0);
    EXPECT_NEAR(-found.distance, sampled(c, from, 0.5, 2000), 1e-3);
    EXPECT_LE(-found.distance, sampled(c, from, 0.5, 2000) + found.error);
    EXPECT_LE(std::abs(std::remainder(found.nearest.theta - theta, 2 * M_PI)), M_PI);
    const Clearance mirrored = q.clearance({0.001, -0.0002, -theta}, 0.5);
    EXPECT_NEAR(found.distance, mirrored.distance, found.error + mirrored.error);
  }
}

TEST(ObstacleQueries, clearance_is_a_lipschitz_function) {
  Random random(9);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    const double w = q.gyration_radius();
    for (int k = 0; k < 200; ++k) {
      const Configuration a = anywhere(c, random),
                          b{a.x + uniform_between(random, -1, 1), a.y + uniform_between(random, -1, 1),
                            a.theta + uniform_between(random, -1, 1)};
      const Clearance at = q.clearance(a), to = q.clearance(b);
      const double moved = std::hypot(a.x - b.x, a.y - b.y, w * (a.theta - b.theta));
      EXPECT_LE(std::abs(at.distance - to.distance), moved + at.error + to.error + 1e-12);
    }
  }
}

// Hundreds of lines are nearly parallel within 1e-6 to 1e-10 radians of the same angles: crossings run along whole
// edges between neighbouring events.
TEST(ObstacleQueries, clearance_of_a_nearly_symmetric_star) {
  Random random(12);
  const Region star = snapped_shapes::star(22, 3.2, 6.9);
  const CspaceObstacle c = make({star, star});
  const ObstacleQueries q(c);
  const double size = frame(c).size, w = q.gyration_radius();
  const int queried = oracles::rounds(120);
  for (int k = 0; k < queried; ++k) {
    Configuration from = anywhere(c, random);
    if (k == 0) from = {2.6755101274912469, 6.1136040221208816, -0.22326770522919492};
    if (k == 1) from = {-2.6585513931131821, 6.6042293465492214, -2.7693829285172318};
    SCOPED_TRACE(testing::Message() << from.x << " " << from.y << " " << from.theta);
    const Clearance found = q.clearance(from);
    EXPECT_LE(found.error, 2e-9 * std::abs(found.distance) + 1e-10 * size);
    // Nothing changes nearer than it says, and the point that is told is on the boundary.
    const double radius = std::abs(found.distance) - found.error;
    for (int i = 0; i < 20; ++i) {
      const double x = uniform_between(random, -1, 1), y = uniform_between(random, -1, 1),
                   z = uniform_between(random, -1, 1);
      const double step = 0.999 * radius * uniform_between(random, 0, 1) / std::sqrt(x * x + y * y + z * z);
      EXPECT_EQ(q.contains({from.x + step * x, from.y + step * y, from.theta + step * z / w}), found.distance < 0);
    }
    EXPECT_LE(std::abs(q.clearance(found.nearest).distance), 1e-6 * size);
    // No slice is nearer, those beside the nearest point in particular.
    for (int i = 0; i < 6; ++i) {
      Configuration at = from;
      at.theta =
          i < 3 ? found.nearest.theta + (i - 1) * 1e-9 : found.nearest.theta + uniform_between(random, -0.1, 0.1);
      const double turn = w * std::remainder(at.theta - from.theta, 2 * M_PI);
      EXPECT_LE(std::abs(found.distance), std::hypot(slice_distance(c, at), turn) + found.error);
    }
  }
  EXPECT_LT(q.bounds_evaluated(), 200u * static_cast<unsigned>(queried));
}

TEST(ObstacleQueries, clearance_looks_at_few_patches) {
  Random random(13);
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    for (int k = 0; k < 300; ++k) q.clearance(anywhere(c, random));
    EXPECT_LT(q.bounds_evaluated(), 40u * 300);
  }
}

bool between(const FreeAngles& f, double theta, double margin) {
  const double begin = f.begin + f.begin_error + margin;
  double end = f.end - f.end_error - margin;
  if (f.end < f.begin) end += 2 * M_PI;
  return (theta > begin && theta < end) || (theta + 2 * M_PI > begin && theta + 2 * M_PI < end);
}

TEST(ObstacleQueries, free_angles_are_those_that_are_free) {
  Random random(10);
  int ends = 0, whole = 0, none = 0;
  for (const auto& pair : pairs()) {
    const CspaceObstacle c = make(pair);
    const ObstacleQueries q(c);
    for (int k = 0; k < oracles::rounds(60); ++k) {
      const Configuration at = anywhere(c, random);
      const std::vector<FreeAngles> free = q.free_angles(at.x, at.y);
      for (int i = 0; i < 500; ++i) {
        const double theta = uniform_between(random, -M_PI, M_PI);
        const bool expected = !c.contains(at.x, at.y, *Orientation::nearest(theta));
        EXPECT_EQ(std::any_of(free.begin(), free.end(), [&](const FreeAngles& f) { return between(f, theta, 0); }),
                  expected);
        if (i > 20) i += 40;
      }
      none += free.empty();
      for (const FreeAngles& f : free) {
        if (f.begin_patch == Patch::kNone) {
          ++whole;
          continue;
        }
        ++ends;
        for (const auto& [angle, error, patch, way] :
             {std::tuple{f.begin, f.begin_error, f.begin_patch, 1}, std::tuple{f.end, f.end_error, f.end_patch, -1}}) {
          EXPECT_LT(error, 1e-6);
          const double step = way * (error + 1e-9);
          EXPECT_FALSE(q.contains({at.x, at.y, angle + step}));
          EXPECT_TRUE(q.contains({at.x, at.y, angle - step}));
          const auto [a, b] = c.ends(c.patches()[patch], angle);
          const double dx = b.x - a.x, dy = b.y - a.y;
          EXPECT_LT(std::abs(dx * (at.y - a.y) - dy * (at.x - a.x)) / std::hypot(dx, dy), 1e-6 * frame(c).size);
        }
      }
    }
  }
  EXPECT_GT(ends, oracles::rounds(100));
  EXPECT_GT(whole, oracles::rounds(20));
  EXPECT_GT(none, oracles::rounds(20));
}

TEST(ObstacleQueries, free_angles_of_a_bar_beside_a_corner) {
  // A bar of half length 4 and half width 1/2, two above the midpoint of a square of side 2: free while it is nearly
  // level.
  const CspaceObstacle c = make({shapes::rectangle(-4, -0.5, 4, 0.5), shapes::rectangle(-1, -1, 1, 1)});
  const ObstacleQueries q(c);
  const std::vector<FreeAngles> free = q.free_angles(0, 2);
  ASSERT_EQ(free.size(), 2u);
  // The line at distance 1/2 below (0, 2) touches a corner (1, 1) at the angle where cos - sin = 1/2.
  const double limit = std::acos(0.5 / std::sqrt(2.0)) - M_PI / 4;
  EXPECT_NEAR(free[0].begin, -limit, 1e-12);
  EXPECT_NEAR(free[0].end, limit, 1e-12);
  EXPECT_NEAR(free[1].begin, M_PI - limit, 1e-12);
  EXPECT_NEAR(free[1].end, -M_PI + limit, 1e-12);
}

TEST(ObstacleQueries, an_exact_fit_between_parts_is_free) {
  Random random(11);
  RegionData two;
  two.parts = {{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}}, {{{2.5, 0}, {4.5, 0}, {4.5, 2}, {2.5, 2}}, {}}};
  const CspaceObstacle c = make({shapes::rectangle(0, 0, 1, 0.5), *Region::create(two)});
  const ObstacleQueries q(c);
  // Turned by a quarter the robot is as wide as the gap: it stands in it, but neither a little beside that nor turned.
  const Orientation quarter = *Orientation::of(1, 1);
  EXPECT_FALSE(q.contains(2.5, 0.5, quarter));
  EXPECT_FALSE(q.contains({2.5, 0.5, M_PI / 2}));
  EXPECT_TRUE(q.contains(2.5 + 0x1p-50, 0.5, quarter));
  EXPECT_TRUE(q.contains({2.5, 0.5, M_PI / 2 + 0x1p-45}));
  for (int k = 0; k < 500; ++k) {
    const Orientation o = k % 2 == 0 ? *Orientation::of(static_cast<int>(random() % 3) - 1, 1)
                                     : *Orientation::nearest(uniform_between(random, -3, 3));
    for (const Point& at : {Point{2.5, uniform_between(random, -1, 2)},
                            Point{uniform_between(random, -1, 5), uniform_between(random, -1, 3)},
                            Point{2 + uniform_between(random, -1e-3, 1e-3), 2}})
      EXPECT_EQ(q.contains(at.x, at.y, o), c.contains(at.x, at.y, o));
  }
  EXPECT_GT(q.exact_answers(), 200u);
}

TEST(ObstacleQueries, the_radius_of_gyration) {
  const CspaceObstacle c = make({shapes::rectangle(-3, -2, 3, 2), shapes::rectangle(0, 0, 1, 1)});
  EXPECT_NEAR(ObstacleQueries(c).gyration_radius(), std::sqrt((36.0 + 16.0) / 12), 1e-14);
  const CspaceObstacle d = make({moved(shapes::rectangle(-3, -2, 3, 2), 10, 0), shapes::rectangle(0, 0, 1, 1)});
  EXPECT_NEAR(ObstacleQueries(d).gyration_radius(), std::sqrt((36.0 + 16.0) / 12 + 100), 1e-13);
}

// In doubles the area of the triangle is zero, or anything. Of a triangle: (a^2 + b^2 + c^2 + (a + b + c)^2) / 12.
TEST(ObstacleQueries, the_radius_of_gyration_of_a_needle) {
  for (const double factor : {1.0, 0x1p300, 0x1p-300}) {
    RegionData data;
    data.parts.push_back({{{0, -0.1}, {-0.1, -0.2}, {0.1 + 0.2, 0.2}}, {}});
    const Region needle = *scaled(*Region::create(data), factor, factor);
    const CspaceObstacle c = make({needle, *scaled(shapes::rectangle(0, 0, 1, 1), factor, factor)});
    EXPECT_NEAR(ObstacleQueries(c).gyration_radius(), std::sqrt(0.02) * factor, 1e-15 * factor);
  }
}

}  // namespace
}  // namespace dymsum
