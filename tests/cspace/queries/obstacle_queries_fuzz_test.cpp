// Random pairs on small grids: questions on and beside the boundary against the exact test, clearances as balls without
// a change, free angles against containment; and pairs at the ends of the range of coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dymsum/obstacle_queries.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/decimal_parts.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double grid(Random& random, int reach) {
  return static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach;
}

Region random_shape(Random& random, int reach) {
  for (;;) {
    RegionData data;
    data.parts.emplace_back();
    const int n = 3 + static_cast<int>(random() % 6);
    for (int i = 0; i < n; ++i) data.parts[0].outer.push_back({grid(random, reach), grid(random, reach)});
    const Result<Repaired> repaired = repair(data);
    if (repaired.ok() && repaired->region.parts().size() == 1 && repaired->region.touching_points().empty())
      return repaired->region;
  }
}

// On a patch or 1e-17 to 1e-9 beside it, at any of its angles, at its first one or 1e-13 beside that.
Configuration near_boundary(const CspaceObstacle& c, Random& random) {
  const Patch& p = c.patches()[random() % c.patches().size()];
  const bool always = p.begin == Patch::kNone;
  const double begin = always ? -M_PI : c.angles()[p.begin].theta;
  double end = always ? M_PI : c.angles()[p.end].theta;
  if (end <= begin) end += 2 * M_PI;
  double theta = begin + (end - begin) * uniform(random, 0, 1);
  if (random() % 4 == 0) theta = begin + (random() % 2 == 0 ? 0 : 1e-13 * uniform(random, -1, 1));
  theta = std::remainder(theta, 2 * M_PI);
  const auto [a, b] = c.ends(p, theta);
  const double fraction = random() % 4 == 0 ? 0 : uniform(random, 0, 1);
  const double beside = std::pow(10, uniform(random, -17, -9)) * (random() % 2 == 0 ? 1 : -1);
  return {a.x + fraction * (b.x - a.x) + beside, a.y + fraction * (b.y - a.y), theta};
}

void expect_contained(const CspaceObstacle& c, const ObstacleQueries& q, const Configuration& at) {
  EXPECT_EQ(q.contains(at), c.contains(at.x, at.y, *Orientation::nearest(at.theta)))
      << at.x << " " << at.y << " " << at.theta;
}

// No point nearer than the clearance differs from its center.
void expect_ball(const ObstacleQueries& q, const Configuration& from, Random& random) {
  const double weight = q.gyration_radius();
  const Clearance found = q.clearance(from);
  const double radius = std::abs(found.distance) - found.error;
  for (int k = 0; k < 20; ++k) {
    const double x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    const double step = 0.999 * radius * uniform(random, 0, 1) / std::sqrt(x * x + y * y + z * z);
    const Configuration to{from.x + step * x, from.y + step * y, from.theta + step * z / weight};
    EXPECT_EQ(q.contains(to), found.distance < 0) << from.x << " " << from.y << " " << from.theta;
  }
}

void expect_angles(const ObstacleQueries& q, double x, double y, Random& random) {
  const std::vector<FreeAngles> free = q.free_angles(x, y);
  for (int k = 0; k < 40; ++k) {
    const double theta = uniform(random, -M_PI, M_PI);
    bool inside = false;
    for (const FreeAngles& f : free)
      inside |= f.single()        ? theta == f.begin
                : f.begin < f.end ? f.begin < theta && theta < f.end
                                  : theta > f.begin || theta < f.end;
    EXPECT_NE(inside, q.contains({x, y, theta})) << x << " " << y << " " << theta;
  }
}

// All kinds of questions within `reach`; returns how many the exact test answered.
std::uint64_t query(const CspaceObstacle& made, double reach, double unit, Random& random) {
  const ObstacleQueries q(made);
  for (int k = 0; k < 40; ++k) expect_contained(made, q, near_boundary(made, random));
  for (int k = 0; k < 40; ++k) {
    const double quarters = M_PI / 2 * (static_cast<int>(random() % 4) - 1);
    expect_contained(
        made, q, {unit * grid(random, 10), unit * grid(random, 10), k % 2 == 0 ? quarters : uniform(random, -3, 3)});
  }
  const std::uint64_t exact = q.exact_answers();
  for (int k = 0; k < 4; ++k)
    expect_ball(q, {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -M_PI, M_PI)},
                random);
  for (int k = 0; k < 3; ++k) expect_angles(q, uniform(random, -reach, reach), uniform(random, -reach, reach), random);
  expect_angles(q, unit * grid(random, 5), unit * grid(random, 5), random);
  return exact;
}

TEST(ObstacleQueriesFuzz, random_pairs_on_grids) {
  Random random(7);
  int pairs = 0;
  std::uint64_t exact = 0;
  const int tries = oracles::kSanitized ? 40 : 150;
  for (int i = 0; i < tries && !HasFailure(); ++i) {
    const Region robot = random_shape(random, 1 + static_cast<int>(random() % 4));
    const Region obstacle = random_shape(random, 1 + static_cast<int>(random() % 6));
    const Result<CspaceObstacle> made = CspaceObstacle::create(robot, obstacle);
    if (!made) continue;
    ++pairs;
    SCOPED_TRACE(testing::Message() << "pair " << i);
    exact += query(*made, 8, 1, random);
  }
  EXPECT_GT(pairs, tries - 20);
  EXPECT_GT(exact, oracles::kSanitized ? 100u : 1000u);
}

TEST(ObstacleQueriesFuzz, coordinates_of_every_kind) {
  Random random(7315);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int pairs = 0;
    const int tries = oracles::kSanitized ? 3 : 10;
    for (int i = 0; i < tries && !HasFailure(); ++i) {
      const Result<Region> robot = Region::create(of_kind(random_shape(random, 3).data(), kind, random)),
                           around = Region::create(of_kind(random_shape(random, 5).data(), kind, random));
      if (!robot.ok() || !around.ok()) continue;
      const Result<CspaceObstacle> made = CspaceObstacle::create(*robot, *around);
      if (!made) continue;
      ++pairs;
      SCOPED_TRACE(testing::Message() << name_of(kind) << ", pair " << i);
      query(*made, kind == CoordinateKind::turned_far ? 1e5 : 8, 1, random);
    }
    EXPECT_GT(pairs, tries / 2) << name_of(kind);
  }
}

TEST(ObstacleQueriesFuzz, several_parts_at_decimal_distances) {
  for (std::uint64_t seed = 1; seed <= 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double unit = random() % 2 == 0 ? 1 : 0.1;
    const Region robot = oracles::decimal_parts(random, 3, 6, 1 + static_cast<int>(random() % 2), unit);
    Region obstacle = oracles::decimal_parts(random, 6, 7, 1 + static_cast<int>(random() % 3), unit);
    if (random() % 2 == 0) obstacle = oracles::framed(obstacle, 12 * unit, 40 * unit);
    query(CspaceObstacle::create(robot, obstacle).value(), 15 * unit, unit, random);
  }
}

TEST(ObstacleQueriesFuzz, segments_and_points) {
  for (std::uint64_t seed = 1; seed <= 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    RegionData robot;
    const Point a{grid(random, 3) + 0.5, grid(random, 3)};
    if (random() % 4 == 0) robot.points.push_back(a);
    else robot.polylines.push_back({a, {grid(random, 3), grid(random, 3)}});
    const CspaceObstacle c = CspaceObstacle::create(*Region::create(robot), random_shape(random, 5)).value();
    query(c, 8, 1, random);
    // At a contact, to the last bit: never less than 0.
    const ObstacleQueries q(c);
    for (int k = 0; k < 10; ++k) {
      const Configuration at{grid(random, 6) / 2, grid(random, 6) / 2, 0};
      EXPECT_EQ(q.clearance(at).distance < 0, c.contains(at.x, at.y, Orientation())) << at.x << ' ' << at.y;
    }
  }
}

// An L, a T and a polygon with a whisker, against parts; and a part among walls.
TEST(ObstacleQueriesFuzz, pieces_without_area) {
  for (std::uint64_t seed = 1; seed <= 24 && !HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double l = 1 + std::abs(grid(random, 2));
    RegionData thin;
    switch (seed % 4) {
      case 0:
        thin.polylines = {{{0, 0}, {l, 0}, {l, 1.5}}};
        break;
      case 1:
        thin.polylines = {{{-l, 0}, {l, 0}}, {{0.5, 0}, {0, 1.5}}};
        break;
      case 2:
        thin.parts = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}};
        thin.polylines = {{{1, 0.5}, {1 + l, 0.5}}};
        break;
      default:
        thin.polylines = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}, {-4, -4}}, {{0, -4}, {0, -l}}, {{0, 0}, {0, 4}}};
        thin.points = {{-2, 1}};
    }
    const Region wires = *Region::create(thin), shape = random_shape(random, seed % 4 == 3 ? 2 : 5);
    const CspaceObstacle c =
        seed % 4 == 3 ? CspaceObstacle::create(shape, wires).value() : CspaceObstacle::create(wires, shape).value();
    query(c, 8, 1, random);
  }
}

// Powers of two change nothing but the scale.
TEST(ObstacleQueriesFuzz, the_largest_and_the_smallest_coordinates) {
  Random random(8);
  const Region robot = shapes::letter_l(3, 2, 0.5), obstacle = shapes::letter_u(4, 3, 0.75);
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  const ObstacleQueries q(c);
  for (const double factor : {0x1p390, 0x1p-300}) {
    const CspaceObstacle d =
        CspaceObstacle::create(*scaled(robot, factor, factor), *scaled(obstacle, factor, factor)).value();
    const ObstacleQueries r(d);
    const std::uint64_t before = q.exact_answers();
    for (int k = 0; k < 200; ++k) {
      const Configuration at{uniform(random, -4, 8), uniform(random, -4, 7), uniform(random, -M_PI, M_PI)};
      const Configuration to{at.x * factor, at.y * factor, at.theta};
      EXPECT_EQ(q.contains(at), r.contains(to));
      const Clearance a = q.clearance(at), b = r.clearance(to);
      EXPECT_NEAR(a.distance, b.distance / factor, a.error + b.error / factor);
      EXPECT_EQ(q.free_angles(at.x, at.y).size(), r.free_angles(to.x, to.y).size());
    }
    EXPECT_EQ(r.exact_answers(), q.exact_answers() - before);
  }
}

}  // namespace
}  // namespace dymsum
