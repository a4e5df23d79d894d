// The planner: scenes whose answers are known, and random ones against a flood fill of certified balls.
#include "dymsum/planner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "cspace/planner/test_rooms.h"
#include "cspace/queries/flood_fill.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "oracles/decimal_parts.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {

using namespace test_rooms;

CspaceObstacle obstacle_of(const Region& robot, const Region& obstacle) {
  return CspaceObstacle::create(robot, obstacle).value();
}

Plan plan_in(const CspaceObstacle& c, Configuration start, Configuration goal, Touching touching = Touching::allowed) {
  PlanOptions options;
  options.touching = touching;
  return plan(c, start, goal, options).value();
}

// Every piece by the public exact checks, and in a strict plan many poses of every piece by contains().
void expect_valid(const CspaceObstacle& c, const Plan& p, Configuration start, Configuration goal, Touching touching) {
  ASSERT_TRUE(p.found());
  ASSERT_FALSE(p.path.empty());
  EXPECT_EQ(p.path.front().approx.x, start.x);
  EXPECT_EQ(p.path.front().approx.y, start.y);
  EXPECT_EQ(p.path.front().theta, *Orientation::nearest(start.theta));
  EXPECT_EQ(p.path.back().approx.x, goal.x);
  EXPECT_EQ(p.path.back().approx.y, goal.y);
  EXPECT_EQ(p.path.back().theta, *Orientation::nearest(goal.theta));
  for (std::size_t k = 1; k < p.path.size(); ++k) {
    expect_free_piece(c, p, k, touching);
    if (testing::Test::HasFatalFailure()) return;
    const Waypoint &a = p.path[k - 1], &b = p.path[k];
    if (touching == Touching::allowed) continue;
    double turn = b.approx.theta - a.approx.theta;
    if (b.move == Waypoint::Move::counter_clockwise && turn < 0) turn += 2 * std::numbers::pi;
    if (b.move == Waypoint::Move::clockwise && turn > 0) turn -= 2 * std::numbers::pi;
    for (int i = 0; i <= 40; ++i) {
      const double s = i / 40.0, x = a.approx.x + s * (b.approx.x - a.approx.x),
                   y = a.approx.y + s * (b.approx.y - a.approx.y);
      const Orientation theta = turn == 0 || i == 0 ? a.theta
                                : i == 40           ? b.theta
                                                    : *Orientation::nearest(a.approx.theta + s * turn);
      ASSERT_FALSE(c.contains(x, y, theta)) << k << " at " << s;
    }
  }
}

void expect_path(const CspaceObstacle& c, Configuration start, Configuration goal,
                 Touching touching = Touching::allowed) {
  const Plan p = plan_in(c, start, goal, touching);
  ASSERT_TRUE(p.found()) << p.reason->text;
  expect_valid(c, p, start, goal, touching);
}

NoPath expect_none(const CspaceObstacle& c, Configuration start, Configuration goal, NoPath::Kind kind,
                   Touching touching = Touching::allowed) {
  const Plan p = plan_in(c, start, goal, touching);
  EXPECT_FALSE(p.found());
  EXPECT_TRUE(p.path.empty());
  if (p.found()) return {};
  EXPECT_EQ(p.reason->kind, kind) << p.reason->text;
  return *p.reason;
}

Region bar() { return region({{box(-3, -0.5, 3, 0.5), {}}}); }
Region square() { return region({{box(0, 0, 1, 1), {}}}); }

TEST(Planner, a_bar_turns_to_pass_a_doorway_narrower_than_its_length) {
  const CspaceObstacle c = obstacle_of(bar(), two_rooms(-1, 1));
  expect_path(c, {-6, 0, std::numbers::pi / 2}, {6, 0, std::numbers::pi / 2});
  expect_path(c, {-6, 0, std::numbers::pi / 2}, {6, 0, -std::numbers::pi / 2}, Touching::forbidden);
}

TEST(Planner, an_L_turns_round_the_jamb) {
  const Region robot = region({{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}}});
  const CspaceObstacle c = obstacle_of(robot, two_rooms(-1.25, 1.25));
  expect_path(c, {-7, -2, 0}, {7, 2, std::numbers::pi}, Touching::forbidden);
}

TEST(Planner, a_bar_cannot_turn_in_a_corridor) {
  const CspaceObstacle c =
      obstacle_of(bar(), region({{box(-20, -3, 20, 3), {{{-19, -2}, {-19, 2}, {19, 2}, {19, -2}}}}}));
  expect_path(c, {-10, 0, 0}, {10, 1, 0.1});
  const NoPath reason = expect_none(c, {-10, 0, 0}, {10, 0, std::numbers::pi}, NoPath::Kind::separated);
  ASSERT_EQ(reason.start.size(), 1u);
  EXPECT_FALSE(reason.start[0].unbounded);
  EXPECT_FALSE(reason.start[0].all_angles);
  EXPECT_LT(reason.start[0].from, 0);
  EXPECT_GT(reason.start[0].to, 0);
}

TEST(Planner, a_bug_trap_is_left_through_its_mouth) {
  const Region trap = bug_trap(0.5);
  const Region robot = region({{{{-0.4, -0.3}, {0.5, -0.2}, {0.1, 0.4}}, {}}});
  const CspaceObstacle c = obstacle_of(robot, trap);
  expect_path(c, {2, 2, 1}, {-9, 3, -2}, Touching::forbidden);
}

TEST(Planner, a_slot_of_exactly_the_width_is_passed_only_by_touching) {
  const CspaceObstacle c = obstacle_of(square(), two_rooms(0, 1));
  const Configuration start{-5, 1.5, 0.3}, goal{5, -2.25, 2};
  expect_path(c, start, goal);
  expect_none(c, start, goal, NoPath::Kind::separated, Touching::forbidden);
  expect_path(c, {-0.5, 0, 0}, goal);
  expect_path(c, {-0.5, 1, -std::numbers::pi / 2}, {0, 0, 0});
}

TEST(Planner, a_slot_a_hair_too_narrow_is_not_passed) {
  const CspaceObstacle c = obstacle_of(square(), two_rooms(0, 1 - 0x1p-20));
  expect_none(c, {-5, 1.5, 0.3}, {5, -2.25, 2}, NoPath::Kind::separated);
  expect_path(c, {-5, 1.5, 0.3}, {-9, -2.25, 2});
}

TEST(Planner, a_slot_a_hair_wider_is_passed_without_touching) {
  const CspaceObstacle c = obstacle_of(square(), two_rooms(0, 1 + 0x1p-20));
  expect_path(c, {-5, 1.5, 0.3}, {5, -2.25, 2}, Touching::forbidden);
}

TEST(Planner, a_slanted_slot_of_exactly_the_width) {
  // The rooms along (3, 4), five times as long: all corners stay integers.
  const Region straight = two_rooms(0, 1);
  RegionData data = straight.data();
  const auto turned = [](Ring& ring) {
    for (Point& p : ring) p = {3 * p.x - 4 * p.y, 4 * p.x + 3 * p.y};
  };
  turned(data.parts[0].outer);
  turned(data.parts[0].holes[0]);
  const CspaceObstacle c = obstacle_of(region({{box(0, 0, 5, 5), {}}}), *Region::create(data));
  expect_path(c, {-15, -20, 0}, {15, 20, 1});
  expect_none(c, {-15, -20, 0}, {15, 20, 1}, NoPath::Kind::separated, Touching::forbidden);
}

TEST(Planner, an_enclosed_start_and_ends_that_are_not_free) {
  const CspaceObstacle c = obstacle_of(square(), two_rooms(-1, 1));
  const NoPath out = expect_none(c, {-5, 0, 0}, {50, 0, 0}, NoPath::Kind::separated);
  EXPECT_FALSE(out.start.at(0).unbounded);
  EXPECT_TRUE(out.start.at(0).all_angles);
  EXPECT_FALSE(out.start.at(0).shells.empty());
  EXPECT_TRUE(out.goal.at(0).unbounded);
  EXPECT_NE(out.text.find("enclosed"), std::string::npos);
  expect_none(c, {-11.5, 0, 0}, {-5, 0, 0}, NoPath::Kind::start_not_free);
  expect_none(c, {-5, 0, 0}, {-11.5, 0, 0}, NoPath::Kind::goal_not_free);
  const NoPath touch = expect_none(c, {-11, 0, 0}, {-5, 0, 0}, NoPath::Kind::start_not_free, Touching::forbidden);
  EXPECT_TRUE(touch.contact.has_value());
  expect_path(c, {-11, 0, 0}, {-5, 0, 0});
}

TEST(Planner, nowhere_to_go_and_once_round) {
  const CspaceObstacle c = obstacle_of(bar(), region({{box(10, 10, 11, 11), {}}}));
  expect_path(c, {0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(plan_in(c, {0, 0, 1}, {0, 0, 1}).path.size(), 1u);
  const Plan round = plan_in(c, {0, 0, 3}, {0, 0, -3});
  ASSERT_EQ(round.path.size(), 2u);
  EXPECT_EQ(round.path[1].move, Waypoint::Move::counter_clockwise);
  expect_valid(c, round, {0, 0, 3}, {0, 0, -3}, Touching::allowed);
}

TEST(Planner, a_square_held_exactly_in_its_own_shape) {
  const CspaceObstacle c = obstacle_of(square(), region({{box(-1, -1, 2, 2), {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}}}));
  expect_path(c, {0, 0, 0}, {0, 0, 0});
  const NoPath held = expect_none(c, {0, 0, 0}, {5, 5, 0}, NoPath::Kind::separated);
  EXPECT_TRUE(held.start.empty());
  expect_none(c, {0, 0, 0}, {1, 0, std::numbers::pi / 2}, NoPath::Kind::separated);
}

double way_length(const Plan& p) {
  double way = 0;
  for (std::size_t k = 1; k < p.path.size(); ++k)
    way += std::hypot(p.path[k].approx.x - p.path[k - 1].approx.x, p.path[k].approx.y - p.path[k - 1].approx.y);
  return way;
}

TEST(Planner, paths_are_drawn_tight) {
  // Round the end of a wall, and through a doorway and back to the other wall.
  const CspaceObstacle wall = obstacle_of(square(), region({{box(-1, -5, 1, 5), {}}}));
  const CspaceObstacle doorway = obstacle_of(bar(), two_rooms(-1, 1));
  const Region trap = bug_trap(0.5);
  const CspaceObstacle mouth = obstacle_of(region({{{{-0.4, -0.3}, {0.5, -0.2}, {0.1, 0.4}}, {}}}), trap);
  struct Way {
    const CspaceObstacle& obstacle;
    Configuration start, goal;
    double most;
  };
  for (const Way& w : {Way{wall, {-6, 0, 0}, {6, 0, std::numbers::pi / 2}, 21},
                       {wall, {-6, -4, 1}, {6, -4, -2}, 13.5},
                       {doorway, {-6, 0, std::numbers::pi / 2}, {6, 0, -std::numbers::pi / 2}, 12.1},
                       {mouth, {2, 2, 1}, {-9, 3, -2}, 13.5}}) {
    for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
      const Plan p = plan_in(w.obstacle, w.start, w.goal, touching);
      expect_valid(w.obstacle, p, w.start, w.goal, touching);
      EXPECT_LT(way_length(p), w.most);
    }
  }
}

// A wall whose ends meet in one point lets nothing through; squares that meet in a corner are walked around.
TEST(Planner, rings_that_touch) {
  const Region robot = region({{box(-0.25, -0.25, 0.25, 0.25), {}}});
  RegionData room, squares;
  room.parts = {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 5}, {2, 8}, {8, 8}, {8, 2}, {2, 2}, {0, 5}}, {}}};
  squares.parts = {{box(0, 0, 2, 2), {}}, {box(2, 2, 5, 5), {}}};
  const CspaceObstacle closed = obstacle_of(robot, *Region::create(room));
  const Plan none = plan_in(closed, {5, 5, 0}, {15, 5, 0});
  ASSERT_FALSE(none.found());
  EXPECT_EQ(none.reason->kind, NoPath::Kind::separated);
  const CspaceObstacle around = obstacle_of(robot, *Region::create(squares));
  for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
    const Configuration start{3, 1, 0.3}, goal{1, 3, 2};
    expect_valid(around, plan_in(around, start, goal, touching), start, goal, touching);
  }
}

// Upright it just touches floor and ceiling: past that only by touching.
TEST(Planner, a_rhombus_in_a_corridor_as_high_as_its_diagonal) {
  const Region robot = region({{{{2, 0}, {0, 1}, {-2, 0}, {0, -1}}, {}}});
  RegionData data;
  data.parts = {{box(-40, -40, 40, 40), {{{-20, -2}, {-20, 2}, {20, 2}, {20, -2}}}}};
  const CspaceObstacle c = obstacle_of(robot, *Region::create(data));
  const Configuration start{-10, 0, 0}, goal{10, 0, std::numbers::pi};
  const Plan none = plan_in(c, start, goal, Touching::forbidden);
  ASSERT_FALSE(none.found());
  EXPECT_EQ(none.reason->kind, NoPath::Kind::separated);
  expect_valid(c, plan_in(c, start, goal), start, goal, Touching::allowed);
}

TEST(Planner, errors) {
  const CspaceObstacle c = obstacle_of(square(), two_rooms(-1, 1));
  EXPECT_EQ(plan(c, {NAN, 0, 0}, {0, 0, 0}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(plan(c, {0, 0, INFINITY}, {0, 0, 0}).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(plan(c, {0x1p401, 0, 0}, {0, 0, 0}).error().code, ErrorCode::unsupported_operand);
  PlanOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(plan(c, {-5, 0, 0}, {5, 0, 1}, options).error().code, ErrorCode::cancelled);
}

using Random = std::mt19937_64;

// A random cave: a star with deep corners, cut out of a rectangle.
Region random_cave(Random& random) {
  for (;;) {
    Part part{box(-8, -8, 8, 8), {Ring{}}};
    for (int k = 0; k < 14; ++k) {
      const double r = 1 + static_cast<double>(random() % 6), angle = -2 * std::numbers::pi * k / 14;
      part.holes[0].push_back({std::round(2 * r * std::cos(angle)) / 2, std::round(2 * r * std::sin(angle)) / 2});
    }
    if (Result<Region> cave = Region::create({{part}, {}, {}})) return std::move(cave).value();
  }
}

// A maze of unit squares in a frame; none of its walls touch only at corners.
Region random_maze(Random& random, int n, std::vector<std::vector<bool>>& wall) {
  for (;;) {
    std::vector<Region> blocks;
    wall.assign(static_cast<std::size_t>(n + 2), std::vector<bool>(static_cast<std::size_t>(n + 2), false));
    for (int i = 0; i <= n + 1; ++i)
      for (int j = 0; j <= n + 1; ++j) {
        const bool solid = i == 0 || j == 0 || i > n || j > n || random() % 5 < 2;
        wall[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = solid;
        if (solid) blocks.push_back(region({{box(i, j, i + 1, j + 1), {}}}));
      }
    Result<Region> all = union_of(blocks)->rounded();
    if (all.ok() && all->touching_points().empty()) return std::move(all).value();
  }
}

TEST(Planner, a_square_in_mazes_of_exactly_its_width) {
  int found = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(oracles::rounds(40)); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::vector<std::vector<bool>> wall;
    const CspaceObstacle c = obstacle_of(square(), random_maze(random, 5, wall));
    std::vector<std::pair<std::size_t, std::size_t>> rooms;
    for (std::size_t i = 0; i < wall.size(); ++i)
      for (std::size_t j = 0; j < wall.size(); ++j)
        if (!wall[i][j]) rooms.emplace_back(i, j);
    if (rooms.empty()) continue;
    std::vector<std::pair<std::size_t, std::size_t>> open{rooms[random() % rooms.size()]};
    const auto [gi, gj] = rooms[random() % rooms.size()];
    const Configuration start{static_cast<double>(open[0].first), static_cast<double>(open[0].second), 0};
    std::vector<std::vector<bool>> seen = wall;
    seen[open[0].first][open[0].second] = true;
    bool reached = false;
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      reached = reached || (i == gi && j == gj);
      for (const auto& [a, b] : {std::pair{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}})
        if (!seen[a][b]) {
          seen[a][b] = true;
          open.emplace_back(a, b);
        }
    }
    // The goal turned by a quarter about its own middle.
    const bool quarter = random() % 2 == 0;
    const Configuration goal{static_cast<double>(gi) + quarter, static_cast<double>(gj),
                             quarter ? std::numbers::pi / 2 : 0};
    const Plan p = plan_in(c, start, goal);
    if (!quarter) {
      ASSERT_EQ(p.found(), reached);
    }
    if (p.found()) {
      ASSERT_TRUE(reached);
      expect_valid(c, p, start, goal, Touching::allowed);
    }
    (p.found() ? found : none)++;
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(found, oracles::rounds(5));
  EXPECT_GT(none, oracles::rounds(5));
}

// There and back: both ways valid, or neither.
TEST(Planner, several_parts_at_decimal_distances) {
  const char* first = std::getenv("DYMSUM_SEED");
  const char* count = std::getenv("DYMSUM_FUZZ_PLANS");
  const std::uint64_t begin = first ? std::stoull(first) : 1;
  int found = 0;
  for (std::uint64_t seed = begin; seed < begin + (count ? std::stoull(count) : 4); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Region robot = oracles::decimal_parts(random, 3, 5, 1 + static_cast<int>(random() % 2), 0.1);
    Region obstacle = oracles::decimal_parts(random, 6, 7, 1 + static_cast<int>(random() % 2), 0.1);
    if (seed % 2 == 0) obstacle = oracles::framed(obstacle, 1.2, 4);
    const CspaceObstacle c = obstacle_of(robot, obstacle);
    std::vector<Configuration> free;
    for (int tries = 0; tries < 1000 && free.size() < 2; ++tries) {
      const auto at = [&](double reach) { return reach * (static_cast<double>(random() % 2001) / 1000 - 1); };
      const Configuration q{at(2), at(1), at(3)};
      if (!c.contains(q.x, q.y, *Orientation::nearest(q.theta))) free.push_back(q);
    }
    if (free.size() < 2) continue;
    for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
      const Plan there = plan_in(c, free[0], free[1], touching), back = plan_in(c, free[1], free[0], touching);
      ASSERT_EQ(there.found(), back.found());
      if (!there.found()) continue;
      ++found;
      expect_valid(c, there, free[0], free[1], touching);
      expect_valid(c, back, free[1], free[0], touching);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_TRUE(first || count || found > 0);
}

TEST(Planner, random_scenes_agree_with_a_flood_fill) {
  const char* first = std::getenv("DYMSUM_SEED");
  const char* count = std::getenv("DYMSUM_FUZZ_PLANS");
  const std::uint64_t begin = first ? std::stoull(first) : 1;
  int found = 0, none = 0, reached_by_flood = 0, undecided = 0;
  double slowest = 0;
  for (std::uint64_t seed = begin; seed < begin + (count ? std::stoull(count) : oracles::kSanitized ? 4 : 12); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const bool cave = seed % 3 != 0;
    const Region robot = random_shape(random, 3, 5, cave ? 0.75 : 0.5);
    const Region obstacle = cave ? random_cave(random) : random_shape(random, 5, 14, 1);
    const CspaceObstacle c = obstacle_of(robot, obstacle);
    constexpr int kSteps = 29, kTurns = 40;
    FloodFill flood(c, 7, kSteps, kTurns);
    std::vector<std::array<int, 3>> free;
    for (int tries = 0; tries < 4000 && free.size() < 5; ++tries) {
      const std::array<int, 3> n{4 + static_cast<int>(random() % 21), 4 + static_cast<int>(random() % 21),
                                 static_cast<int>(random() % kTurns)};
      if (flood.gap(n[0], n[1], n[2]) > 0.01) free.push_back(n);
    }
    for (std::size_t k = 1; k < free.size(); ++k) {
      const auto [i, j, t] = free[k];
      const Configuration start = flood.at(free[0][0], free[0][1], free[0][2]), goal = flood.at(i, j, t);
      const bool joined = flood.reached(free[0])[static_cast<std::size_t>((t * kSteps + i) * kSteps + j)];
      const auto touching = random() % 2 == 0 ? Touching::forbidden : Touching::allowed;
      const Plan p = plan_in(c, start, goal, touching);
      slowest = std::max(slowest, p.work.ms);
      reached_by_flood += joined;
      (p.found() ? found : none)++;
      undecided += !p.found() && p.reason->kind == NoPath::Kind::undecided;
      if (joined) {
        ASSERT_TRUE(p.found()) << p.reason->text;
      }
      if (p.found()) expect_valid(c, p, start, goal, touching);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  std::cout << found << " found, " << none << " none, " << reached_by_flood << " reached by the flood fill, slowest "
            << slowest << " ms\n";
  EXPECT_EQ(undecided, 0);
  EXPECT_TRUE(first || count || oracles::kSanitized || (found > 0 && none > 0 && reached_by_flood > 0));
}

// Posts, tilted as rounded coordinates tilt them: `kind` 0 in steps of 2^-10, 1 in three decimals, 2 in single
// precision.
Region posts(int n, int kind) {
  std::mt19937_64 random(5);
  std::vector<Part> parts;
  const auto rounded = [&](double v) {
    return kind == 0 ? std::round(v * 1024) / 1024 : kind == 1 ? std::round(v * 1000) / 1000 : static_cast<float>(v);
  };
  for (int k = 0; k < n * n; ++k) {
    const double turn = static_cast<double>(random() >> 11) * 0x1p-53;
    Ring ring;
    for (int i = 0; i < 4; ++i) {
      const double at = turn + i * std::numbers::pi / 2;
      ring.push_back({rounded(3 * (k % n) + 0.4 * std::cos(at)), rounded(3 * (k / n) + 0.4 * std::sin(at))});
    }
    parts.push_back({ring, {}});
  }
  return region(std::move(parts));
}

// Took thousands of slices, all of them kept, and the obstacle of all angles before.
TEST(Planner, a_free_turn_beside_many_posts_looks_at_slices_at_its_ends_alone) {
  const Region rod = region({{box(-1, -0.125, 1, 0.125), {}}});
  for (int kind = 0; kind < 3; ++kind) {
    const Region obstacle = posts(6, kind);
    for (const Configuration goal : {Configuration{-3, -3, 1}, {-3, 18, 0}, {-3, 18, 1}}) {
      const auto direct = direct_plan(rod, obstacle, {-3, -3, 0}, goal);
      ASSERT_TRUE(direct.ok() && *direct && (*direct)->found()) << kind;
      EXPECT_LE((*direct)->work.slices, 2u);
      EXPECT_LE((*direct)->path.size(), 3u);
    }
    const auto blocked = direct_plan(rod, obstacle, {-3, -3, 0}, {0, 0, 1});
    ASSERT_TRUE(blocked.ok() && *blocked);
    EXPECT_EQ((*blocked)->reason->kind, NoPath::Kind::goal_not_free);
  }
  const auto not_direct =
      direct_plan(rod, two_rooms(-0.2, 0.2), {-4, 0, std::numbers::pi / 2}, {4, 0, std::numbers::pi / 2});
  EXPECT_TRUE(not_direct.ok() && (!*not_direct || (*not_direct)->found()));
}

TEST(Planner, slices_that_were_let_go_of_are_made_again) {
  const CspaceObstacle c = obstacle_of(region({{box(-1, -0.25, 1, 0.25), {}}}), posts(3, 0));
  PlanOptions few;
  few.slice_bytes = 1;
  const Configuration start{1.5, 1.5, 0}, goal{4.5, 4.5, 2.5};
  const Plan all = plan(c, start, goal).value(), again = plan(c, start, goal, few).value();
  ASSERT_TRUE(all.found());
  ASSERT_EQ(again.path.size(), all.path.size());
  for (std::size_t k = 0; k < all.path.size(); ++k) {
    EXPECT_EQ(again.path[k].theta, all.path[k].theta);
    EXPECT_EQ(again.path[k].approx, all.path[k].approx);
  }
  EXPECT_GE(again.work.slices, all.work.slices);
}

}  // namespace
}  // namespace dymsum
