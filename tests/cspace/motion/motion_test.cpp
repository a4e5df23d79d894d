// Motions of a robot: known contacts, and random ones against dense samples by the exact contains().
#include "dymsum/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "cspace/planner/test_rooms.h"
#include "dymsum/path_check.h"
#include "dymsum/region.h"
#include "oracles/decimal_parts.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {
constexpr auto kAhead = TurnDirection::counter_clockwise;
constexpr auto kBack = TurnDirection::clockwise;

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
Region region(std::vector<Part> parts) { return *Region::create({std::move(parts), {}, {}}); }
Region square() { return region({{box(0, 0, 1, 1), {}}}); }
Orientation turned(std::int64_t n, std::int64_t d) { return *Orientation::of(n, d); }

TEST(Translation, stops_where_it_touches_and_names_the_contact) {
  const Region wall = region({{box(5, -2, 6, 2), {}}});
  const TranslationCheck check = *check_translation(square(), wall, Point{0, 0}, Point{12, 0}, {});
  EXPECT_FALSE(check.free);
  EXPECT_EQ(check.first, *Rational::of(1, 3));
  EXPECT_EQ(check.at.x, *Rational::of(4, 1));
  ASSERT_TRUE(check.contact.has_value());
  EXPECT_EQ(*check.contact, (Contact{Contact::Kind::edge_of_p, 3, 1}));
}

TEST(Translation, touching_is_free_unless_forbidden) {
  const Region wall = region({{box(5, -2, 6, 2), {}}});
  for (const auto& [from, to] :
       {std::pair{Point{4, -9}, Point{4, 9}}, {Point{0, 0}, Point{4, 0}}, {Point{4, 0}, Point{4, 0}}}) {
    EXPECT_TRUE(check_translation(square(), wall, from, to, {})->free);
    EXPECT_FALSE(check_translation(square(), wall, from, to, {}, Touching::forbidden)->free);
  }
  EXPECT_EQ(check_translation(square(), wall, Point{0, 0}, Point{4, 0}, {}, Touching::forbidden)->first,
            *Rational::of(1, 1));
  EXPECT_TRUE(check_translation(square(), wall, Point{0, 0}, Point{3.5, 0}, {}, Touching::forbidden)->free);
}

TEST(Translation, through_a_slot_of_exactly_the_width) {
  const Region walls = region({{box(0, 1, 9, 2), {}}, {box(0, -1, 9, 0), {}}});
  EXPECT_TRUE(check_translation(square(), walls, Point{-5, 0}, Point{20, 0}, {})->free);
  EXPECT_FALSE(check_translation(square(), walls, Point{-5, 0}, Point{20, 0}, {}, Touching::forbidden)->free);
  EXPECT_FALSE(check_translation(square(), walls, Point{-5, 0}, Point{20, 0x1p-40}, {})->free);
  EXPECT_FALSE(check_translation(square(), walls, Point{-5, 0}, Point{20, 0}, turned(1, 1 << 30))->free);
}

TEST(Translation, out_of_the_hole_of_a_ring_and_between_parts) {
  const Region ring = region({{box(0, 0, 9, 9), {{{2, 2}, {2, 7}, {7, 7}, {7, 2}}}}});
  EXPECT_TRUE(check_translation(square(), ring, Point{3, 3}, Point{6, 6}, {})->free);
  const TranslationCheck out = *check_translation(square(), ring, Point{3, 3}, Point{11, 3}, {});
  EXPECT_EQ(out.first, *Rational::of(3, 8));
  EXPECT_FALSE(check_translation(square(), ring, Point{0.5, 0.5}, Point{3, 3}, {})->free);
}

TEST(Translation, a_start_deep_inside_has_no_contact) {
  const TranslationCheck check =
      *check_translation(square(), region({{box(0, 0, 9, 9), {}}}), Point{3, 3}, Point{30, 3}, {});
  EXPECT_FALSE(check.free);
  EXPECT_EQ(check.first, *Rational::of(0, 1));
  EXPECT_FALSE(check.contact.has_value());
}

TEST(Translation, errors) {
  EXPECT_EQ(check_translation(square(), square(), Point{NAN, 0}, Point{}, {}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(check_rotation(square(), {}, Point{0, 0}, {}, {}, kAhead).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(check_motion(square(), {}, {}, {}).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(check_motion(square(), square(), {NAN, 0, 0}, {}).error().code, ErrorCode::not_finite);
}

TEST(Rotation, a_bar_turns_until_it_meets_a_corner) {
  const Region bar = region({{box(0, -1, 5, 1), {}}}), block = region({{{{3, 4}, {9, 4}, {9, 9}, {3, 9}}, {}}});
  const RotationCheck check = *check_rotation(bar, block, Point{0, 0}, {}, turned(1, 1), kAhead);
  EXPECT_FALSE(check.free);
  ASSERT_TRUE(check.first.has_value());
  // The corner (3, 4) is 5 away; the upper edge of the bar is 1 from its axis, the corner of the bar at sqrt(26).
  EXPECT_LT(check.first->theta, std::atan2(4, 3) - std::asin(1.0 / 5) + 1e-12);
  ASSERT_TRUE(check.contact.has_value());
  EXPECT_TRUE(check_rotation(bar, block, Point{0, 0}, {}, turned(1, 1), kBack)->free);
  ASSERT_EQ(check.free_angles.size(), 1u);
  EXPECT_EQ(check.free_angles[0].end.theta, check.first->theta);
  EXPECT_FALSE(check.always);
}

TEST(Rotation, touching_all_the_time_is_free_unless_forbidden) {
  const Region wing = region({{{{0, 0}, {2, -1}, {2, 1}}, {}}}), wall = region({{box(-3, -9, 0, 9), {}}});
  EXPECT_TRUE(check_rotation(wing, wall, Point{0, 0}, turned(-1, 3), turned(1, 3), kAhead)->free);
  EXPECT_FALSE(check_rotation(wing, wall, Point{0, 0}, turned(-1, 3), turned(1, 3), kAhead, Touching::forbidden)->free);
  EXPECT_FALSE(check_rotation(wing, wall, Point{0, 0}, turned(-1, 3), turned(1, 3), kBack)->free);
  EXPECT_TRUE(check_rotation(wing, wall, Point{3, 0}, turned(-1, 3), turned(1, 3), kBack, Touching::forbidden)->free);
  EXPECT_TRUE(check_rotation(wing, wall, Point{3, 0}, {}, {}, kBack)->always);
  EXPECT_TRUE(check_rotation(wing, wall, Point{0, 0}, {}, {}, kAhead)->free);
  EXPECT_FALSE(check_rotation(wing, wall, Point{-1, 0}, {}, {}, kAhead)->free);
}

TEST(Rotation, a_touch_on_the_way_or_at_its_end) {
  // The corner (1, 0) comes to (0, 1) after a quarter turn and passes it along the edge y = 1, its highest place.
  const Region spike = region({{{{0, 0}, {1, 0}, {0.5, 0.125}}, {}}}), roof = region({{box(-5, 1, 5, 2), {}}});
  EXPECT_TRUE(check_rotation(spike, roof, Point{0, 0}, {}, Orientation::half_turn(), kAhead)->free);
  const RotationCheck touch =
      *check_rotation(spike, roof, Point{0, 0}, {}, Orientation::half_turn(), kAhead, Touching::forbidden);
  EXPECT_FALSE(touch.free);
  EXPECT_EQ(touch.first->exact, turned(1, 1));
  EXPECT_FALSE(check_rotation(spike, roof, Point{0, 0}, {}, turned(1, 1), kAhead, Touching::forbidden)->free);
  EXPECT_FALSE(check_rotation(spike, roof, Point{0, 0}, turned(1, 1), {}, kBack, Touching::forbidden)->free);
  EXPECT_TRUE(check_rotation(spike, roof, Point{0, 0}, {}, turned(99, 100), kAhead, Touching::forbidden)->free);
}

using Random = std::mt19937_64;
using test_rooms::random_shape;

std::uint64_t rounds(std::uint64_t usual) {
  const char* count = std::getenv("DYMSUM_FUZZ_MOTIONS");
  return count ? std::stoull(count) : oracles::kSanitized ? usual / 2 : usual;
}

// Every other one of one part on a grid, else of several parts at decimal distances, sometimes in a frame.
struct Scene {
  Region robot, obstacle;
  double unit = 1;  // of its size, a power of two
};
Scene random_scene(Random& random, std::uint64_t seed, int robot_reach) {
  if (seed % 2 == 0) return {random_shape(random, robot_reach, 5), random_shape(random, 4, 7), 1};
  Scene scene;
  const double unit = random() % 2 == 0 ? 0.5 : 0.1;
  scene.unit = unit == 0.5 ? 0.5 : 0.125;
  scene.robot = oracles::decimal_parts(random, robot_reach, 5, 1 + static_cast<int>(random() % 2), unit);
  scene.obstacle = oracles::decimal_parts(random, 5, 7, 1 + static_cast<int>(random() % 3), unit);
  if (random() % 3 == 0) scene.obstacle = oracles::framed(scene.obstacle, 8 * unit, 30 * unit);
  return scene;
}

TEST(Translation, random_ways_agree_with_samples) {
  int free = 0, blocked = 0;
  for (std::uint64_t seed = 1; seed <= rounds(150); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto [robot, obstacle, unit] = random_scene(random, seed, 2);
    const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
    const auto at = [&, u = unit] { return 0.5 * u * (static_cast<int>(random() % 33) - 16); };
    const Point from{at(), at()}, to{at(), at()};
    const Orientation theta = turned(static_cast<int>(random() % 5) - 2, 1 + static_cast<int>(random() % 3));
    const TranslationCheck check = *check_translation(robot, obstacle, from, to, theta);
    // 64 shares with exact doubles.
    double first = 2;
    for (int i = 64; i >= 0; --i)
      if (c.contains(from.x + i / 64.0 * (to.x - from.x), from.y + i / 64.0 * (to.y - from.y), theta)) first = i / 64.0;
    if (first <= 1) {
      EXPECT_FALSE(check.free);
      EXPECT_LE(check.first.to_double(), first);
    }
    (check.free ? free : blocked)++;
    if (check_translation(robot, obstacle, from, to, theta, Touching::forbidden)->free) {
      EXPECT_TRUE(check.free);
    }
    if (check.free || from == to) continue;
    // Just after the first contact it overlaps (unless what it passes is a corner cut off by a rounding), just before
    // it does not.
    const double f = check.first.to_double(), e = 1e-9;
    if (f + e < 1 && unit == 1) {
      EXPECT_TRUE(c.contains(from.x + (f + e) * (to.x - from.x), from.y + (f + e) * (to.y - from.y), theta));
    }
    if (f > e) {
      EXPECT_FALSE(c.contains(from.x + (f - e) * (to.x - from.x), from.y + (f - e) * (to.y - from.y), theta));
    }
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(blocked, 10);
}

TEST(Rotation, random_turns_agree_with_samples) {
  int free = 0, blocked = 0;
  for (std::uint64_t seed = 1; seed <= rounds(150); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto [robot, obstacle, unit] = random_scene(random, seed, 3);
    const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
    const Point at{0.5 * unit * (static_cast<int>(random() % 25) - 12),
                   0.5 * unit * (static_cast<int>(random() % 25) - 12)};
    const Orientation from = turned(static_cast<int>(random() % 9) - 4, 1 + static_cast<int>(random() % 3));
    const Orientation to = turned(static_cast<int>(random() % 9) - 4, 1 + static_cast<int>(random() % 3));
    const auto direction = random() % 2 == 0 ? kAhead : kBack;
    const RotationCheck check = *check_rotation(robot, obstacle, at, from, to, direction);
    double turn = to.radians() - from.radians();
    if (direction == kAhead && turn < 0) turn += 2 * std::numbers::pi;
    if (direction == kBack && turn > 0) turn -= 2 * std::numbers::pi;
    double until = 2;  // the fraction of the turn at the first contact
    if (!check.free)
      until = check.first->theta == from.radians()
                  ? 0
                  : std::fmod(std::abs(turn > 0 ? check.first->theta - from.radians() + 2 * std::numbers::pi
                                                : from.radians() - check.first->theta + 2 * std::numbers::pi),
                              2 * std::numbers::pi) /
                        std::abs(turn);
    for (int i = 1; i < 100; ++i) {
      const double s = i / 100.0;
      const Orientation theta = *Orientation::nearest(from.radians() + s * turn);
      if (turn != 0 && s < until - 1e-9) {
        ASSERT_FALSE(c.contains(at.x, at.y, theta)) << s;
      }
      // Membership in the intervals is what contains() says.
      bool inside = check.always;
      bool near = false;
      for (const TurnInterval& f : check.free_angles) {
        const double a = f.begin.theta, b = f.end.theta, x = theta.radians();
        inside = inside || (a < b ? a < x && x < b : x > a || x < b);
        // Rounded to one angle, or past each other, the ends do not say nothing from the whole circle.
        near = near || std::abs(a - b) < 1e-12 || std::abs(x - a) < 1e-9 || std::abs(x - b) < 1e-9;
      }
      const bool overlaps = c.contains(at.x, at.y, theta);
      if (near) continue;
      if (!inside && !overlaps) {  // a single angle, at which it touches
        ASSERT_FALSE(check_rotation(robot, obstacle, at, theta, theta, kAhead, Touching::forbidden)->free)
            << theta.radians();
      } else {
        ASSERT_NE(inside, overlaps) << theta.radians();
      }
    }
    if (!check.free && turn != 0 && until + 1e-7 < 1 && unit == 1) {
      EXPECT_TRUE(c.contains(at.x, at.y, *Orientation::nearest(from.radians() + (until + 1e-7) * turn)));
    }
    (check.free ? free : blocked)++;
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(blocked, 10);
}

TEST(Motion, free_blocked_and_grazing) {
  const Region wall = region({{box(5, -2, 6, 2), {}}});
  const MotionCheck free = *check_motion(square(), wall, {0, 0, 0}, {0, 9, 20});
  EXPECT_EQ(free.outcome, MotionCheck::Outcome::free);
  const MotionCheck blocked = *check_motion(square(), wall, {0, 0, 0}, {12, 0, 0});
  EXPECT_EQ(blocked.outcome, MotionCheck::Outcome::blocked);
  EXPECT_LE(blocked.low, 1.0 / 3);
  EXPECT_GE(blocked.high, 1.0 / 3);
  EXPECT_LT(blocked.high - blocked.low, 1e-4);
  ASSERT_TRUE(blocked.contact.has_value());
  const MotionCheck grazing = *check_motion(square(), wall, {4, -9, 0}, {4, 9, 0});
  EXPECT_EQ(grazing.outcome, MotionCheck::Outcome::undecided);
  EXPECT_GT(grazing.low, 0.3);
  EXPECT_EQ(check_motion(square(), wall, {5.5, 0, 0}, {12, 0, 0})->outcome, MotionCheck::Outcome::blocked);
  EXPECT_EQ(check_motion(square(), wall, {5.5, 0, 0}, {12, 0, 0})->low, 0);
  MotionOptions few;
  few.most_poses = 3;
  EXPECT_EQ(check_motion(square(), wall, {0, 0, 0}, {3.99, 0, 7}, few)->outcome, MotionCheck::Outcome::undecided);
}

TEST(Motion, a_single_motion_asks_progress_and_stops) {
  const Region wall = region({{box(5, -2, 6, 2), {}}});
  const Configuration a{3.999, -9, 0}, b{3.999, 9, 1e-9};
  std::vector<double> fractions;
  const Progress count = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  const MotionCheck check = check_motion(square(), wall, a, b, {}, count).value();
  EXPECT_GT(check.poses, 100u);
  EXPECT_GE(fractions.size(), check.poses / 32);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()) && fractions.back() <= 1);
  for (const std::size_t queried : {std::size_t{1}, fractions.size()}) {
    std::size_t left = queried;
    const Progress stop = [&](std::string_view, double) { return --left > 0; };
    EXPECT_EQ(check_motion(square(), wall, a, b, {}, stop).error().code, ErrorCode::cancelled);
  }
  fractions.clear();
  const std::vector<Configuration> path{{0, -9, 0}, a, b};
  ASSERT_TRUE(check_path(square(), wall, path, Touching::allowed, {}, count).ok());
  EXPECT_GT(fractions.size(), 4u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()) && fractions.back() <= 1);
}

TEST(Motion, whole_turns_far_away_are_free_at_any_angle) {
  const Region wall = region({{box(5, -2, 6, 2), {}}});
  for (const double turns : {1e8, -1e12, 1e300})
    for (const double from : {0.0, 3e7, -1e308}) {
      SCOPED_TRACE(testing::Message() << from << " and " << turns);
      EXPECT_EQ(check_motion(square(), wall, {0, 0, from}, {0, 9, from + turns})->outcome, MotionCheck::Outcome::free);
      EXPECT_NE(check_motion(square(), wall, {0, 0, from}, {12, 0, from + turns})->outcome, MotionCheck::Outcome::free);
    }
  EXPECT_EQ(check_motion(square(), wall, {0, 0, 1e308}, {0, 9, -1e308})->outcome, MotionCheck::Outcome::free);
  // A start of many turns is that of its exact remainder.
  const double start = 421657428.0, reduced = Orientation::nearest(start)->radians();
  const Configuration near{4, 0, start}, far{3.9, 3, start + 0.5}, near_0{4, 0, reduced}, far_0{3.9, 3, reduced + 0.5};
  const MotionCheck a = *check_motion(square(), wall, near, far), b = *check_motion(square(), wall, near_0, far_0);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.poses, b.poses);
}

// Powers of two change nothing, also where squares of coordinates leave the range of doubles.
TEST(Motion, tiny_shapes_are_those_of_their_size) {
  for (std::uint64_t seed = 1; seed <= rounds(20); ++seed) {
    Random random(seed);
    const auto [robot, obstacle, unit] = random_scene(random, seed, 2);
    const auto at = [&](double reach) { return reach * (static_cast<double>(random() % 2001) / 1000 - 1); };
    const Configuration a{at(8 * unit), at(8 * unit), at(3)}, b{at(8 * unit), at(8 * unit), at(9)};
    const MotionCheck whole = *check_motion(robot, obstacle, a, b);
    for (const int exponent : {-300, -520, -600, -900}) {
      const double s = std::ldexp(1.0, exponent);
      const auto small = [&](Configuration c) { return Configuration{s * c.x, s * c.y, c.theta}; };
      const MotionCheck check = *check_motion(*scaled(robot, s, s), *scaled(obstacle, s, s), small(a), small(b));
      EXPECT_EQ(check.outcome, whole.outcome) << seed << ' ' << exponent;
    }
  }
}

TEST(Motion, random_ways_agree_with_samples) {
  std::array<int, 3> outcomes{};
  for (std::uint64_t seed = 1; seed <= rounds(150); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto [robot, obstacle, unit] = random_scene(random, seed, 2);
    const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
    const auto at = [&](double reach) { return reach * (static_cast<double>(random() % 2001) / 1000 - 1); };
    const double wide = 8 * unit;
    const Configuration a{at(wide), at(wide), at(3)}, b{at(wide), at(wide), at(9)};
    const MotionCheck check = *check_motion(robot, obstacle, a, b);
    outcomes[static_cast<std::size_t>(check.outcome)]++;
    for (int i = 0; i <= 200; ++i) {
      const double t = i / 200.0;
      const Orientation theta = *Orientation::nearest(a.theta + t * (b.theta - a.theta));
      if (t < check.low || check.outcome == MotionCheck::Outcome::free) {
        ASSERT_FALSE(c.contains(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), theta)) << t;
      }
    }
    if (check.outcome != MotionCheck::Outcome::blocked) continue;
    const double t = check.high;
    EXPECT_TRUE(c.contains(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                           *Orientation::nearest(a.theta + t * (b.theta - a.theta))));
    EXPECT_LT(check.high - check.low, 1e-4);
  }
  EXPECT_GT(outcomes[0], 10);
  EXPECT_GT(outcomes[1], 10);
  EXPECT_LT(outcomes[2], 3);
}

}  // namespace
}  // namespace dymsum
