// Our certified motions and our planner against a sampling planner's: OMPL samples motions with a collision test of its
// own, in doubles. What we call free has no colliding sample, what we call blocked is in contact where we say so, and
// where we say that there is no path OMPL finds none whose motions are free.
#include <gtest/gtest.h>

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <cstdlib>
#include <iostream>
#include <numbers>

#include "dymsum/motion.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/planner.h"
#include "plain_collision.h"
#include "rooms.h"

namespace dymsum::sampling {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Random = std::mt19937_64;
using State = ob::SE2StateSpace::StateType;
using Scoped = ob::ScopedState<ob::SE2StateSpace>;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// How many random rooms: DYMSUM_FUZZ_OBSTACLES times as many as without it.
int scaled(int n) {
  const char* factor = std::getenv("DYMSUM_FUZZ_OBSTACLES");
  return n * (factor != nullptr ? std::max(1, std::atoi(factor) / 4) : 1);
}

Configuration of(const ob::State* s) {
  const auto* state = s->as<State>();
  return {state->getX(), state->getY(), state->getYaw()};
}

// As OMPL interpolates: the shorter way round.
Configuration towards(const Configuration& a, Configuration b) {
  b.theta = a.theta + std::remainder(b.theta - a.theta, 2 * std::numbers::pi);
  return b;
}
Configuration along(const Configuration& a, const Configuration& b, double fraction) {
  return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y), a.theta + fraction * (b.theta - a.theta)};
}

// A space of poses with OMPL's own validator, which looks at samples.
class Sampler {
 public:
  explicit Sampler(const Room& room)
      : plain(room.robot, room.obstacle), space_(std::make_shared<ob::SE2StateSpace>()), setup(space_) {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-room.size);
    bounds.setHigh(room.size);
    space_->setBounds(bounds);
    setup.setStateValidityChecker([this](const ob::State* s) { return !plain.overlaps(of(s)); });
    setup.getSpaceInformation()->setStateValidityCheckingResolution(0.0005);
    setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
    setup.setup();
  }

  Scoped state(const Configuration& c) const {
    Scoped s(space_);
    s->setXY(c.x, c.y);
    const double yaw = std::remainder(c.theta, 2 * std::numbers::pi);
    s->setYaw(yaw < std::numbers::pi ? yaw : -std::numbers::pi);  // OMPL's angles end before pi
    return s;
  }
  struct Verdict {
    bool valid = true;
    double last_valid = 1, step = 0;  // shares of the way
  };
  Verdict moves(const Configuration& a, const Configuration& b) const {
    const Scoped from = state(a), to = state(b);
    Verdict v;
    std::pair<ob::State*, double> last(nullptr, 1);
    v.valid = setup.getSpaceInformation()->checkMotion(from.get(), to.get(), last);
    if (!v.valid) v.last_valid = last.second;
    v.step = 1.0 / space_->validSegmentCount(from.get(), to.get());
    return v;
  }
  /// A path of free samples, if one is found in time.
  std::vector<Configuration> solve(const Configuration& a, const Configuration& b, double seconds) {
    setup.clear();
    setup.setStartAndGoalStates(state(a), state(b));
    if (setup.solve(seconds) != ob::PlannerStatus::EXACT_SOLUTION) return {};
    std::vector<Configuration> path;
    for (const ob::State* s : setup.getSolutionPath().getStates()) path.push_back(of(s));
    return path;
  }

  PlainCollision plain;

 private:
  std::shared_ptr<ob::SE2StateSpace> space_;

 public:
  og::SimpleSetup setup;
};

struct Count {
  int free = 0, blocked = 0, undecided = 0, missed = 0;
};

// A motion in x, y and theta at once.
void compare_motion(const Room& room, const Sampler& sampler, const Configuration& a, const Configuration& goal,
                    Count& count) {
  const Configuration b = towards(a, goal);
  SCOPED_TRACE(testing::Message() << room.name << ": " << a.x << " " << a.y << " " << a.theta << " to " << b.x << " "
                                  << b.y << " " << b.theta);
  const MotionCheck ours = check_motion(room.robot, room.obstacle, a, b).value();
  const Sampler::Verdict theirs = sampler.moves(a, b);
  const double length = std::hypot(b.x - a.x, b.y - a.y) + sampler.plain.reach() * std::abs(b.theta - a.theta);
  switch (ours.outcome) {
    case MotionCheck::Outcome::free:
      ++count.free;
      EXPECT_TRUE(theirs.valid) << "free, but sampled to collide behind " << theirs.last_valid;
      EXPECT_GT(sampler.plain.gap(along(a, b, 0.5)), 0);
      break;
    case MotionCheck::Outcome::blocked:
      ++count.blocked;
      count.missed += theirs.valid;
      EXPECT_LE(sampler.plain.gap(along(a, b, ours.low)), length * (ours.high - ours.low) + 2 * kDoubt);
      EXPECT_TRUE(sampler.plain.overlaps(along(a, b, ours.high)) || sampler.plain.gap(along(a, b, ours.high)) < 1e-5);
      break;
    case MotionCheck::Outcome::undecided:
      ++count.undecided;
      EXPECT_LE(sampler.plain.gap(along(a, b, ours.low)), length * 0x1p-18 + 2 * kDoubt);
      break;
  }
  // No sample collides before what is proved to be free ends.
  if (!theirs.valid) {
    EXPECT_NE(ours.outcome, MotionCheck::Outcome::free);
    for (int k = 0; k < 50; ++k) EXPECT_FALSE(sampler.plain.overlaps(along(a, b, ours.low * k / 50)));
  }
}

// The exact checks of a motion in one place or at one angle.
void compare_straight(const Room& room, const Sampler& sampler, const Configuration& a, const Configuration& goal,
                      Count& count) {
  const Orientation theta = *Orientation::nearest(a.theta), to = *Orientation::nearest(goal.theta);
  const TranslationCheck line =
      check_translation(room.robot, room.obstacle, Point{a.x, a.y}, {goal.x, goal.y}, theta).value();
  const Sampler::Verdict moved = sampler.moves(a, {goal.x, goal.y, a.theta});
  (line.free ? count.free : count.blocked)++;
  EXPECT_TRUE(moved.valid || !line.free) << room.name << ": a free translation is sampled to collide";
  if (!line.free && !moved.valid) {
    EXPECT_LE(line.first.to_double(), moved.last_valid + moved.step) << room.name;
  }
  if (!line.free && line.contact) {
    EXPECT_LT(sampler.plain.gap({line.at.x.to_double(), line.at.y.to_double(), a.theta}), 1e-8) << room.name;
  }
  const double turn = std::remainder(goal.theta - a.theta, 2 * std::numbers::pi);
  const TurnDirection way = turn > 0 ? TurnDirection::counter_clockwise : TurnDirection::clockwise;
  const RotationCheck pivot = check_rotation(room.robot, room.obstacle, Point{a.x, a.y}, theta, to, way).value();
  const Sampler::Verdict turned = sampler.moves(a, {a.x, a.y, goal.theta});
  (pivot.free ? count.free : count.blocked)++;
  EXPECT_TRUE(turned.valid || !pivot.free) << room.name << ": a free rotation is sampled to collide";
  if (!pivot.free && pivot.first) {
    EXPECT_LT(sampler.plain.gap({a.x, a.y, pivot.first->theta}), 1e-8) << room.name;
    const double ahead = std::abs(std::remainder(pivot.first->theta - a.theta, 2 * std::numbers::pi));
    if (!turned.valid) {
      EXPECT_LE(ahead, std::abs(turn) * (turned.last_valid + turned.step) + 1e-9) << room.name;
    }
  }
}

Configuration free_position(const Room& room, const PlainCollision& plain, Random& random) {
  for (;;) {
    const Configuration c{uniform(random, -room.size, room.size), uniform(random, -room.size, room.size),
                          uniform(random, -std::numbers::pi, std::numbers::pi)};
    if (!plain.overlaps(c) && plain.gap(c) > 1e-3) return c;
  }
}

void add_random_rooms(std::vector<Room>& rooms, Random& random, int n) {
  for (int k = 0; k < n; ++k) {
    rooms.push_back({"cave " + std::to_string(k), small_robot(random), cave(random), {}, 9});
    rooms.push_back({"boxes " + std::to_string(k), small_robot(random), boxes(random), {}, 10});
  }
}

TEST(Ompl, sampled_motions_agree_with_certified_ones) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  Random random(1);
  std::vector<Room> rooms = known_rooms();
  add_random_rooms(rooms, random, scaled(5));
  Count motions, straight;
  for (const Room& room : rooms) {
    const Sampler sampler(room);
    for (int k = 0; k < 60; ++k) {
      const Configuration a = free_position(room, sampler.plain, random);
      Configuration b = free_position(room, sampler.plain, random);
      if (k % 2 == 0) b = along(a, towards(a, b), 0.2);  // many of the long ones are blocked
      if (sampler.plain.overlaps(b)) continue;
      compare_motion(room, sampler, a, b, motions);
      compare_straight(room, sampler, a, b, straight);
    }
  }
  std::cout << motions.free << " motions free, " << motions.blocked << " blocked, " << motions.missed
            << " of them not seen by samples, " << motions.undecided << " undecided; " << straight.free
            << " translations and rotations free, " << straight.blocked << " blocked\n";
  EXPECT_GT(motions.free, 200);
  EXPECT_GT(motions.blocked, 200);
  EXPECT_LT(motions.undecided, 10);
  EXPECT_GT(straight.free, 200);
  EXPECT_GT(straight.blocked, 200);
}

// Every piece of our path by OMPL's samples; touching is no collision for them.
void expect_sampled(const Room& room, const Sampler& sampler, const Plan& plan) {
  for (std::size_t k = 1; k < plan.path.size(); ++k) {
    const Configuration &a = plan.path[k - 1].approx, &b = plan.path[k].approx;
    double turn = b.theta - a.theta;
    if (plan.path[k].move == Waypoint::Move::counter_clockwise && turn < 0) turn += 2 * std::numbers::pi;
    if (plan.path[k].move == Waypoint::Move::clockwise && turn > 0) turn -= 2 * std::numbers::pi;
    // OMPL turns the shorter way.
    for (int part = 0; part < 3; ++part) {
      const Configuration from{along(a, {b.x, b.y, a.theta + turn}, part / 3.0)};
      const Configuration to{along(a, {b.x, b.y, a.theta + turn}, (part + 1) / 3.0)};
      EXPECT_TRUE(sampler.moves(from, to).valid) << room.name << ": piece " << k << " of a path";
    }
  }
}

struct Tally {
  int both = 0, ours_only = 0, none = 0, tunnels = 0;
};

void compare_plans(const Room& room, const CspaceObstacle& obstacle, Sampler& sampler, const Configuration& start,
                   const Configuration& goal, Tally& tally) {
  SCOPED_TRACE(testing::Message() << room.name << ": " << start.x << " " << start.y << " " << start.theta << " to "
                                  << goal.x << " " << goal.y << " " << goal.theta);
  const Plan ours = plan(obstacle, start, goal).value();
  if (ours.found()) expect_sampled(room, sampler, ours);
  const std::vector<Configuration> theirs = sampler.solve(start, goal, ours.found() ? 1.0 : 0.4);
  if (theirs.empty()) {
    (ours.found() ? tally.ours_only : tally.none)++;
    return;
  }
  if (ours.found()) {
    ++tally.both;
    return;
  }
  // Samples may jump over a thin wall; a path that is certified would refute us.
  bool certified = true;
  for (std::size_t k = 1; k < theirs.size() && certified; ++k)
    certified = check_motion(room.robot, room.obstacle, theirs[k - 1], towards(theirs[k - 1], theirs[k]))->outcome ==
                MotionCheck::Outcome::free;
  EXPECT_FALSE(certified) << "no path, but OMPL found a free one";
  ++tally.tunnels;
}

TEST(Ompl, finds_no_path_where_there_is_none) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  Random random(2);
  std::vector<Room> rooms = known_rooms();
  add_random_rooms(rooms, random, scaled(5));
  Tally tally;
  for (Room& room : rooms) {
    const CspaceObstacle obstacle = CspaceObstacle::create(room.robot, room.obstacle).value();
    Sampler sampler(room);
    while (room.positions.size() < 3) room.positions.push_back(free_position(room, sampler.plain, random));
    for (std::size_t i = 0; i < room.positions.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        compare_plans(room, obstacle, sampler, room.positions[k], room.positions[i], tally);
  }
  std::cout << tally.both << " found by both, " << tally.ours_only << " by us only, " << tally.none << " by none, "
            << tally.tunnels << " by jumping over walls\n";
  EXPECT_GT(tally.both, 20);
  EXPECT_GT(tally.none, 10);
}

}  // namespace
}  // namespace dymsum::sampling
