// Clearance, depth and free angles where placements are tight: named cases, and random cells in rooms against a slow
// answer that looks at exact slices only.
#include <gtest/gtest.h>

#include <limits>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/shapes.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

constexpr double kPi = std::numbers::pi, kOnlyTurns = std::numeric_limits<double>::infinity();

Region square() { return polygon(box(0, 0, 1, 1)); }
Region exact_room() { return polygon(box(-1, -1, 2, 2), {reversed(box(0, 0, 1, 1))}); }

void expect_contact(const Clearance& c) {
  EXPECT_EQ(c.distance, 0);
  EXPECT_FALSE(std::signbit(c.distance));
  EXPECT_EQ(c.error, 0);
}

void expect_singles(const std::vector<FreeAngles>& free, const std::vector<double>& expected) {
  ASSERT_EQ(free.size(), expected.size());
  for (std::size_t k = 0; k < free.size(); ++k) {
    EXPECT_TRUE(free[k].single());
    EXPECT_NEAR(free[k].begin, expected[k], free[k].begin_error);
    EXPECT_LT(free[k].begin_error, 1e-14);
  }
}

TEST(TightClearance, of_a_square_in_its_exact_room) {
  const CspaceObstacle c = CspaceObstacle::create(square(), exact_room()).value();
  EXPECT_EQ(c.tight().size(), 4u);
  const ObstacleQueries q(c);
  for (const Configuration& jammed :
       {Configuration{0, 0, 0}, {1, 0, kPi / 2}, {1, 1, kPi}, {1, 1, -kPi}, {1, 1, 3 * kPi}, {0, 1, -kPi / 2}}) {
    for (const double weight : {q.gyration_radius(), 0.0, 1e-3, 1e3, kOnlyTurns})
      expect_contact(q.clearance(jammed, weight));
    EXPECT_EQ(q.clearance(jammed, kOnlyTurns, Touching::forbidden).distance, -2);
    const Clearance loose = q.clearance(jammed, 0.8, Touching::forbidden);
    EXPECT_LT(loose.distance, -1.5);
    EXPECT_EQ(q.clearance(loose.nearest, 0.8, Touching::allowed).patch != Patch::kNone, true);
  }
  const double w = q.gyration_radius();
  EXPECT_NEAR(q.clearance({0, 0, 0.5}).distance, -0.5 * w, 1e-9);
  EXPECT_NEAR(q.clearance({0.25, 0, 0.125}).distance, -std::hypot(0.25, 0.125 * w), 1e-9);
  EXPECT_NEAR(q.clearance({0, 0, 0.5}, 0).distance, 0, 1e-9);
  // By translation alone only the positions of this very angle count.
  EXPECT_NEAR(q.clearance({0.25, 0, 0}, kOnlyTurns).distance, -0.25, 1e-9);
  EXPECT_NEAR(q.clearance({0.25, 0, 1e-14}, kOnlyTurns).distance, -1.75, 1e-9);
  EXPECT_NEAR(q.clearance({0.25, 0, 0x1p-60}, kOnlyTurns).distance, -1.75, 1e-9);
  expect_singles(q.free_angles(0, 0), {0});
  expect_singles(q.free_angles(1, 1), {kPi});
  expect_singles(q.free_angles(0, 1), {-kPi / 2});
  EXPECT_TRUE(q.free_angles(0.5, 0.5).empty());
  EXPECT_TRUE(q.free_angles(0x1p-60, 0).empty());
}

TEST(TightClearance, of_a_peg_between_the_walls_of_its_slot) {
  const Region slot = polygon({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}});
  const CspaceObstacle c = CspaceObstacle::create(polygon(box(0, 0, 2, 1)), slot).value();
  const ObstacleQueries q(c);
  for (const double weight : {q.gyration_radius(), 0.0, kOnlyTurns}) {
    expect_contact(q.clearance({1, 1, 0}, weight));
    expect_contact(q.clearance({1, 2.25, 0}, weight));
    EXPECT_NEAR(q.clearance({0.999999, 2, 0}, weight).distance,
                weight == 0 ? q.clearance({0.999999, 2, 0}, 0).distance : -1e-6, 1e-9);
  }
  // On the floor outside the slot it stands level, or half turned; a single angle where it is jammed between the walls.
  expect_singles(q.free_angles(1, 2), {0});
  EXPECT_EQ(q.clearance({1, 2, 0}, kOnlyTurns, Touching::forbidden).distance, -2);
}

// Darts whose tips are held by pins at an eighth of a turn, which no rational tangent of the half angle meets.
TEST(TightClearance, at_an_irrational_angle) {
  const auto turned = [](Ring ring, int quarters) {
    for (Point& p : ring)
      for (int k = 0; k < quarters; ++k) p = {-p.y, p.x};
    return ring;
  };
  RegionData darts, pins, two_darts, two_pins;
  for (int k = 0; k < 4; ++k) {
    const bool blocks_ahead = k % 2 == 0;
    darts.parts.push_back(
        {turned(blocks_ahead ? Ring{{4, 0}, {5, -3}, {6, -2}} : Ring{{4, 0}, {6, 2}, {5, 3}}, k), {}});
    pins.parts.push_back({turned(blocks_ahead ? Ring{{2, 2}, {4, 4}, {2, 4}} : Ring{{2, 2}, {4, 2}, {4, 4}}, k), {}});
  }
  const CspaceObstacle c = CspaceObstacle::create(*Region::create(darts), *Region::create(pins)).value();
  const ObstacleQueries q(c);
  const Clearance near = q.clearance({0, 0, kPi / 4});
  EXPECT_TRUE(q.contains({0, 0, kPi / 4}));
  EXPECT_LE(near.distance, 0);
  EXPECT_GT(near.distance, -1e-10);
  EXPECT_NEAR(q.clearance({0.125, 0, kPi / 4 + 0.001}).distance, -std::hypot(0.125, 0.001 * q.gyration_radius()), 1e-9);
  // Two of them do not hold it, but the way it turns: the single angle is no tight placement.
  two_darts.parts = {darts.parts[0], darts.parts[1]};
  two_pins.parts = {pins.parts[0], pins.parts[1]};
  const CspaceObstacle loose = CspaceObstacle::create(*Region::create(two_darts), *Region::create(two_pins)).value();
  for (const CspaceObstacle* obstacle : {&c, &loose}) {
    int singles = 0;
    for (const FreeAngles& f : ObstacleQueries(*obstacle).free_angles(0, 0)) {
      singles += f.single();
      // Four of them hold it half a turn further too.
      if (f.single()) {
        EXPECT_NEAR(f.begin, f.begin > 0 ? kPi / 4 : -3 * kPi / 4, f.begin_error);
      }
    }
    EXPECT_EQ(singles, obstacle == &c ? 2 : 1);
  }
  EXPECT_LT(ObstacleQueries(loose).clearance({0, 0, kPi / 4}).distance, 1e-9);
}

// Three tips slide on three walls at once: at (65 sin, -65 sin) the robot is jammed at every angle near 0.
TEST(TightClearance, along_a_curve) {
  RegionData tips, walls;
  tips.parts = {
      {{{65, 0}, {70, 15}, {60, 15}}, {}}, {{{0, 65}, {-15, 70}, {-15, 60}}, {}}, {{{65, 65}, {70, 50}, {80, 60}}, {}}};
  walls.parts = {
      {{{30, 0}, {65, -30}, {100, 0}}, {}}, {{{0, 30}, {30, 65}, {0, 100}}, {}}, {{{40, 40}, {90, 90}, {50, 80}}, {}}};
  const CspaceObstacle c = CspaceObstacle::create(*Region::create(tips), *Region::create(walls)).value();
  EXPECT_TRUE(c.may_have_tight_curves());
  const ObstacleQueries q(c);
  const double theta = 2 * std::atan(0.125);
  const Orientation o = *Orientation::of(1, 8);
  ASSERT_EQ(*Orientation::nearest(theta), o);
  ASSERT_FALSE(c.contains(16, -16, o));
  EXPECT_FALSE(q.contains(16, -16, o));
  EXPECT_FALSE(q.contains({16, -16, theta}));
  EXPECT_TRUE(q.contains({16, -16, theta + 1e-9}));
  expect_contact(q.clearance({16, -16, theta}));
  expect_contact(q.clearance({16, -16, theta}, kOnlyTurns));
  EXPECT_NEAR(q.clearance({16.5, -16, theta}, kOnlyTurns).distance, -0.5, 1e-9);
  EXPECT_LT(q.clearance({16, -16, theta}, q.gyration_radius(), Touching::forbidden).distance, -1e-3);
  const std::vector<FreeAngles> free = q.free_angles(16, -16);
  EXPECT_TRUE(std::any_of(free.begin(), free.end(), [&](const FreeAngles& f) {
    return f.single() && std::abs(f.begin - theta) <= f.begin_error;
  }));
}

TEST(TightClearance, touching_forbidden) {
  const CspaceObstacle c = CspaceObstacle::create(square(), square()).value();
  const ObstacleQueries q(c);
  for (const double weight : {q.gyration_radius(), kOnlyTurns}) {
    expect_contact(q.clearance({1, 0.5, 0}, weight));
    const Clearance strict = q.clearance({1, 0.5, 0}, weight, Touching::forbidden);
    EXPECT_EQ(strict.distance, 0);
    EXPECT_TRUE(std::signbit(strict.distance));
    EXPECT_NE(strict.patch, Patch::kNone);
    for (const Configuration& off : {Configuration{3, 0.5, 0}, {0.5, 0.5, 0.25}})
      EXPECT_EQ(q.clearance(off, weight, Touching::forbidden).distance, q.clearance(off, weight).distance);
  }
}

TEST(TightClearance, weights_beyond_what_angles_tell_are_refused) {
  const CspaceObstacle c = CspaceObstacle::create(square(), exact_room()).value();
  const ObstacleQueries q(c);
  EXPECT_THROW(q.clearance({5, 0, 0}, 1e300), std::invalid_argument);
  const Clearance far = q.clearance({5, 0, 0}, q.largest_weight());
  EXPECT_NEAR(far.distance, 3, far.error);
  EXPECT_TRUE(std::isfinite(far.error));
}

double to_segment(Point z, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  const double t = l > 0 ? std::clamp(((z.x - a.x) * dx + (z.y - a.y) * dy) / l, 0.0, 1.0) : 0.0;
  return std::hypot(z.x - a.x - t * dx, z.y - a.y - t * dy);
}

// To all that bounds the open slice.
double to_slice(const PlanarSum& slice, Point z) {
  double least = kOnlyTurns;
  const auto add = [&](const SumRing& ring) {
    for (std::size_t i = 0; i < ring.vertices.size(); ++i)
      least = std::min(least, to_segment(z, ring.vertices[i].at, ring.vertices[(i + 1) % ring.vertices.size()].at));
  };
  for (const SumPart& part : slice.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  for (const SumSegment& s : slice.tight_segments) least = std::min(least, to_segment(z, s.from.at, s.to.at));
  for (const SumVertex& v : slice.tight_points) least = std::min(least, to_segment(z, v.at, v.at));
  return least;
}

// Slices all round the circle and at the rational event angles.
struct Slices {
  std::vector<std::pair<double, PlanarSum>> all;
  explicit Slices(const CspaceObstacle& c) {
    for (int k = 0; k < 96; ++k) add(c, *Orientation::nearest(-3.1 + k * 2 * kPi / 96, 1e-3));
    for (const EventAngle& a : c.angles())
      if (a.exact) add(c, *a.exact);
  }
  void add(const CspaceObstacle& c, const Orientation& o) {
    all.emplace_back(o.radians(), *c.slice(o, Semantics::open));
  }
  double distance(const Configuration& q, double weight) const {
    double least = kOnlyTurns;
    for (const auto& [theta, slice] : all)
      least =
          std::min(least, std::hypot(to_slice(slice, {q.x, q.y}), weight * std::remainder(theta - q.theta, 2 * kPi)));
    return least;
  }
};

// At quarter turns, exactly, and at others.
void expect_free_angles(const CspaceObstacle& c, const ObstacleQueries& q, Point z, int& singles) {
  const std::vector<FreeAngles> free = q.free_angles(z.x, z.y);
  const auto covered = [&](double theta) {
    return std::any_of(free.begin(), free.end(), [&](const FreeAngles& f) {
      const double b = f.begin - f.begin_error, e = f.end + f.end_error;
      return f.begin <= f.end ? b <= theta && theta <= e : theta >= b || theta <= e;
    });
  };
  for (const int n : {-1, 0, 1, 2}) {
    const Orientation o = n == 2 ? Orientation::half_turn() : *Orientation::of(n, 1);
    const bool expected = !c.contains(z.x, z.y, o);
    EXPECT_EQ(covered(o.radians()), expected) << z.x << ' ' << z.y << " quarter " << n;
    if (!expected) continue;
    const bool beside = !c.contains(z.x, z.y, *Orientation::nearest(o.radians() - 1e-7)) ||
                        !c.contains(z.x, z.y, *Orientation::nearest(o.radians() + 1e-7));
    const bool single = std::any_of(free.begin(), free.end(),
                                    [&](const FreeAngles& f) { return f.single() && f.begin == o.radians(); });
    EXPECT_NE(single, beside) << z.x << ' ' << z.y << " quarter " << n;
    singles += single;
  }
  for (int k = 0; k < 60; ++k) {
    const double theta = -3.13 + k * 6.26 / 60;
    EXPECT_EQ(covered(theta), !q.contains({z.x, z.y, theta}));
  }
}

TEST(TightClearance, of_cells_in_rooms_against_slices) {
  int singles = 0, jammed = 0, to_tight = 0, touching = 0;
  for_seeds(24, [&](Random& random) {
    const Region robot = random_cells(random, 2, 1), room = random_cells(random, 3, 1);
    RegionData data;
    data.parts.push_back({box(-20, -20, 20, 20), {}});
    for (const Part& part : room.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    const Result<Region> obstacle = Region::create(data);
    if (!obstacle) return;
    SCOPED_TRACE("robot " + format_region(robot, RegionFormat::wkt) + "\nobstacle " +
                 format_region(*obstacle, RegionFormat::wkt));
    const CspaceObstacle c = CspaceObstacle::create(robot, *obstacle).value();
    const ObstacleQueries q(c);
    const Slices slices(c);
    const double w = q.gyration_radius();
    for (int k = 0; k < 24; ++k) {
      const double step = k % 3 == 0 ? 0.5 : 1;
      const auto at = [&] { return step * (static_cast<double>(random() % 13) - 6); };
      const double quarter = static_cast<double>(random() % 4) * kPi / 2 - kPi / 2;
      const Configuration from{at(), at(), k % 4 == 3 ? quarter + 0.3 : quarter};
      SCOPED_TRACE(testing::Message() << from.x << ' ' << from.y << ' ' << from.theta);
      const Clearance found = q.clearance(from, w), flat = q.clearance(from, kOnlyTurns);
      const double slow = slices.distance(from, w);
      EXPECT_LE(std::abs(found.distance), slow + found.error + 1e-9);
      EXPECT_GE(std::abs(found.distance), slow - 0.2 * w);
      EXPECT_NEAR(std::abs(flat.distance),
                  to_slice(*c.slice(*Orientation::nearest(from.theta), Semantics::open), {from.x, from.y}),
                  flat.error + 1e-9);
      EXPECT_EQ(std::signbit(found.distance), q.contains(from));
      EXPECT_EQ(std::signbit(flat.distance), q.contains(from));
      to_tight += found.distance < 0 && found.patch == Patch::kNone;
      if (k % 4 != 3 && !q.contains(from)) {
        // Not in the open set, but in the closed one.
        const PlanarSum slice = *c.slice(*Orientation::nearest(from.theta), Semantics::open);
        const bool touches = to_slice(slice, {from.x, from.y}) < 1e-9;
        EXPECT_EQ(found.distance == 0, touches);
        EXPECT_EQ(flat.distance == 0, touches);
        touching += touches;
        jammed += touches && found.patch == Patch::kNone;
      }
      // A ball without a change.
      const double radius = std::abs(found.distance) - found.error;
      for (int i = 0; i < 6 && radius > 0; ++i) {
        const auto fraction = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
        const double x = fraction(), y = fraction(), z = fraction(), length = std::sqrt(x * x + y * y + z * z) + 1e-9;
        const double f = 0.999 * radius / length;
        EXPECT_EQ(q.contains({from.x + f * x, from.y + f * y, from.theta + f * z / w}), found.distance < 0);
      }
      if (k % 3 == 1) expect_free_angles(c, q, {from.x, from.y}, singles);
    }
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(singles, oracles::kSanitized ? 0 : 5);
  EXPECT_GT(touching, oracles::kSanitized ? 0 : 5);
  EXPECT_GT(jammed, 0);
  EXPECT_GT(to_tight, 5);
}

}  // namespace
}  // namespace dymsum
