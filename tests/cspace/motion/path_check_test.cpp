// Paths that are given, and margins: the first piece that is blocked, and distances measured along the way.
#include "dymsum/path_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dymsum/grown_region.h"
#include "dymsum/planner.h"

namespace dymsum {
namespace {

Region shape(Ring outer, std::vector<Ring> holes = {}) {
  return Region::create({{{std::move(outer), std::move(holes)}}, {}, {}}).value();
}

Ring rectangle_ring(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

Region corner() {
  return shape(rectangle_ring(-1, -1, 19, 19), {{{0, 0}, {0, 18}, {1, 18}, {1, 1}, {18, 1}, {18, 0}}});
}

std::vector<std::array<Point, 2>> edges_of(const Region& region) {
  std::vector<std::array<Point, 2>> edges;
  const auto add = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) edges.push_back({ring[k], ring[(k + 1) % ring.size()]});
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return edges;
}

double distance(Point p, const std::array<Point, 2>& e) {
  const double dx = e[1].x - e[0].x, dy = e[1].y - e[0].y;
  const double t = std::clamp(((p.x - e[0].x) * dx + (p.y - e[0].y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - e[0].x - t * dx, p.y - e[0].y - t * dy);
}

// Of boundaries that do not cross: from a vertex of one to an edge of the other.
double distance(const std::vector<std::array<Point, 2>>& a, const std::vector<std::array<Point, 2>>& b) {
  double least = INFINITY;
  for (const auto& e : a)
    for (const auto& f : b) least = std::min({least, distance(e[0], f), distance(f[0], e)});
  return least;
}

TEST(GrownRegion, holds_the_disc_about_every_point_and_little_more) {
  const Region frame = shape({{0.1, 0}, {7.3, -1}, {8, 5.7}, {0, 6}}, {{{2, 2}, {2, 4}, {5, 4.1}, {5, 2}}});
  for (const double margin : {1e-12, 1e-3, 0.1, 0.75})
    for (const int sides : {3, 4, 16, 64}) {
      const GrownRegion grown_frame = grown(frame, margin, sides).value();
      const auto inner = edges_of(frame), outer = edges_of(grown_frame.region);
      EXPECT_GE(distance(inner, outer), margin) << margin << ' ' << sides;
      for (const auto& e : outer) {
        double least = INFINITY;
        for (const auto& f : inner) least = std::min(least, distance(e[0], f));
        EXPECT_LE(least, grown_frame.at_most);
      }
      EXPECT_LE(grown_frame.at_most, margin / std::cos(std::numbers::pi / sides) * 1.0001 + 1e-13);
    }
  EXPECT_EQ(grown(frame, 0)->region, frame);
  for (const double wrong : {-1.0, std::nan(""), 0x1p401})
    EXPECT_EQ(grown(frame, wrong).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(grown(frame, 1, 2).error().code, ErrorCode::out_of_range);
}

// Poses between the waypoints, in doubles: none comes nearer than the margin but for their rounding.
TEST(GrownRegion, a_path_keeps_the_margin) {
  const Region robot = shape(rectangle_ring(-0.5, -0.125, 0.5, 0.125)), obstacle = corner();
  const auto walls = edges_of(obstacle);
  for (const double margin : {0.05, 0.1, 0.2}) {
    const GrownRegion thick = grown(robot, margin).value();
    const CspaceObstacle c = CspaceObstacle::create(thick.region, obstacle).value();
    const Plan p = plan(c, {4, 0.5, 0}, {0.5, 16, -std::numbers::pi / 2}).value();
    ASSERT_TRUE(p.found()) << p.reason->text;
    EXPECT_EQ(check_path(thick.region, obstacle, std::span<const Waypoint>(p.path))->outcome,
              MotionCheck::Outcome::free);
    double least = INFINITY;
    for (std::size_t k = 1; k < p.path.size(); ++k) {
      const Configuration a = p.path[k - 1].approx, b = p.path[k].approx;
      const double turn = std::remainder(b.theta - a.theta, 2 * std::numbers::pi);
      for (int i = 0; i <= 50; ++i) {
        const double s = i / 50.0, theta = a.theta + s * turn, x = a.x + s * (b.x - a.x), y = a.y + s * (b.y - a.y);
        auto placed = edges_of(robot);
        for (auto& e : placed)
          for (Point& q : e)
            q = {x + std::cos(theta) * q.x - std::sin(theta) * q.y, y + std::sin(theta) * q.x + std::cos(theta) * q.y};
        least = std::min(least, distance(placed, walls));
      }
    }
    EXPECT_GE(least, margin - 1e-13);
  }
  // The corridor is 1 wide, and the robot 0.25.
  const CspaceObstacle full = CspaceObstacle::create(grown(robot, 0.4)->region, obstacle).value();
  EXPECT_EQ(plan(full, {4, 0.5, 0}, {0.5, 16, -std::numbers::pi / 2})->reason->kind, NoPath::Kind::start_not_free);
}

TEST(PathCheck, names_the_first_piece_that_is_blocked) {
  const Region robot = shape(rectangle_ring(-0.25, -0.125, 0.25, 0.125)),
               bar = shape(rectangle_ring(-0.5, -0.125, 0.5, 0.125));
  const Region obstacle = corner();
  const std::vector<Configuration> way{{4, 0.5, 0},
                                       {1, 0.5, 0},
                                       {0.625, 0.5, 0},
                                       {0.5, 0.625, -std::numbers::pi / 2},
                                       {0.5, 0.5, -std::numbers::pi / 2},
                                       {0.5, 9, -std::numbers::pi / 2},
                                       {2, 9, -std::numbers::pi / 2},
                                       {2, 9, 9}};
  const PathCheck wall = check_path(robot, obstacle, way).value();
  EXPECT_EQ(wall.outcome, MotionCheck::Outcome::blocked);
  EXPECT_EQ(wall.piece, 5u);  // from the pose of index 5 to the next one
  EXPECT_EQ(wall.pieces, 6u);
  EXPECT_TRUE(wall.moves && !wall.turns);
  EXPECT_EQ(wall.low, 0.25);  // from 0.5 to 0.875 of the way to 2
  EXPECT_EQ(wall.at, (Configuration{0.875, 9, -std::numbers::pi / 2}));
  ASSERT_TRUE(wall.contact.has_value());
  const auto part = std::span(way).first(6);
  EXPECT_EQ(check_path(robot, obstacle, part)->outcome, MotionCheck::Outcome::free);
  EXPECT_EQ(check_path(robot, obstacle, part)->pieces, 5u);
  // Turning in a corridor: the ends meet the walls where half the diagonal reaches them.
  const std::vector<Configuration> turn{{9, 0.5, 0}, {9, 0.5, 7}};
  const PathCheck stopped = check_path(bar, obstacle, turn).value();
  EXPECT_EQ(stopped.outcome, MotionCheck::Outcome::blocked);
  EXPECT_TRUE(stopped.turns && !stopped.moves);
  const double angle = std::asin(0.5 / std::hypot(0.5, 0.125)) - std::atan2(0.125, 0.5);
  EXPECT_NEAR(stopped.low * 7, angle, 1e-12);
  // A whole turn comes back to where it started, and is not free for that.
  const std::vector<Configuration> round{{9, 0.5, 0}, {9, 0.5, 2 * std::numbers::pi}},
      back{{9, 0.5, 0}, {9, 0.5, -2 * std::numbers::pi}};
  EXPECT_NEAR(check_path(bar, obstacle, round)->at.theta, angle, 1e-12);
  EXPECT_NEAR(check_path(bar, obstacle, back)->at.theta, -angle, 1e-12);
}

// Whole turns are taken off exactly, so that the first contact is where it is at the angle itself.
TEST(PathCheck, angles_of_many_turns) {
  const Region bar = shape(rectangle_ring(-0.5, -0.125, 0.5, 0.125)), obstacle = corner();
  for (const double theta : {1e8, 1e15, -3e300}) {
    const double reduced = Orientation::nearest(theta)->radians();
    const std::vector<Configuration> far{{50, 0, theta}, {50, 9, -theta}};
    EXPECT_EQ(check_path(bar, obstacle, far)->outcome, MotionCheck::Outcome::free) << theta;
    const std::vector<Configuration> turn{{9, 0.75, theta}, {9, 0.75, theta + 3}};
    const std::vector<Configuration> same{{9, 0.75, reduced}, {9, 0.75, reduced + (turn[1].theta - theta)}};
    const PathCheck a = check_path(bar, obstacle, turn).value(), b = check_path(bar, obstacle, same).value();
    EXPECT_EQ(a.outcome, b.outcome);
    EXPECT_NEAR(a.low, b.low, 1e-12) << theta;
  }
}

TEST(PathCheck, one_pose_touching_and_wrong_paths) {
  const Region robot = shape(rectangle_ring(-0.5, -0.125, 0.5, 0.125)), obstacle = corner();
  const std::vector<Configuration> touching{{4, 0.125, 0}}, inside{{4, 0, 0}}, both{{4, 0.125, 0}, {5, 0.5, 0.1}}, none;
  EXPECT_EQ(check_path(robot, obstacle, touching)->outcome, MotionCheck::Outcome::free);
  EXPECT_EQ(check_path(robot, obstacle, touching, Touching::forbidden)->outcome, MotionCheck::Outcome::blocked);
  const PathCheck overlap = check_path(robot, obstacle, inside).value();
  EXPECT_EQ(overlap.outcome, MotionCheck::Outcome::blocked);
  EXPECT_EQ(overlap.piece, 0u);
  EXPECT_EQ(overlap.low, 0);
  // It leaves a touch while it turns, which no resolution tells.
  EXPECT_EQ(check_path(robot, obstacle, both)->outcome, MotionCheck::Outcome::undecided);
  EXPECT_EQ(check_path(robot, obstacle, none).error().code, ErrorCode::malformed);
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  std::vector<Waypoint> path = plan(c, {4, 0.5, 0}, {0.5, 16, -std::numbers::pi / 2}).value().path;
  ASSERT_GE(path.size(), 3u);
  EXPECT_EQ(check_path(robot, obstacle, std::span<const Waypoint>(path))->outcome, MotionCheck::Outcome::free);
  const auto code = [&] { return check_path(robot, obstacle, std::span<const Waypoint>(path)).error().code; };
  std::swap(path[1].move, path[2].move);
  EXPECT_EQ(code(), ErrorCode::malformed);
  path[1].move = Waypoint::Move::start;
  EXPECT_EQ(code(), ErrorCode::malformed);
  path.erase(path.begin());
  path[0].move = Waypoint::Move::translation;
  EXPECT_EQ(code(), ErrorCode::malformed);
}

}  // namespace
}  // namespace dymsum
