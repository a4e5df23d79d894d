// The adapter for OMPL: what its classes call free has no collision at any sample, what they promise of last valid
// states holds, and the planner answers what dymsum's own does.
#include <gtest/gtest.h>

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/samplers/MaximizeClearanceValidStateSampler.h>
#include <ompl/base/samplers/MinimumClearanceValidStateSampler.h>
#include <ompl/util/Console.h>

#include <cmath>
#include <limits>
#include <random>

#include "walls.h"

namespace dymsum::sampling {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;
using Scoped = ob::ScopedState<ob::SE2StateSpace>;

/// Nothing but a wall, so that bounds alone are at its ends.
Region wall_without_a_room() {
  return Region::create({{{{{-0.5, -60}, {0.5, -60}, {0.5, 60}, {-0.5, 60}}, {}}}, {}, {}}).value();
}

class OmplAdapter : public testing::Test {
 protected:
  void SetUp() override { ::ompl::msg::setLogLevel(::ompl::msg::LOG_NONE); }

  static Scoped at(const og::SimpleSetup& setup, double x, double y, double yaw) {
    Scoped state(setup.getStateSpace());
    state->setXY(x, y);
    state->setYaw(yaw);
    return state;
  }
};

TEST_F(OmplAdapter, states_are_valid_exactly_up_to_the_touch) {
  const auto scene = scene_with_wall(0.5);
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const double beyond = std::nextafter(1.5, 0);
  EXPECT_TRUE(si->isValid(at(setup, -1.5, 0, 0).get()));
  EXPECT_FALSE(si->isValid(at(setup, -beyond, 0, 0).get()));
  EXPECT_TRUE(si->isValid(at(setup, 0.9, 0, std::numbers::pi / 2).get()));
  EXPECT_FALSE(si->isValid(at(setup, 0, 0, 0).get()));
  EXPECT_FALSE(si->isValid(at(setup, -51, 0, 0).get())) << "out of bounds";
  EXPECT_FALSE(si->isValid(at(setup, std::nan(""), 0, 0).get()));

  const ob::StateValidityCheckerPtr& checker = setup.getStateValidityChecker();
  EXPECT_EQ(checker->getSpecs().clearanceComputationType, ob::StateValidityCheckerSpecs::EXACT);
  EXPECT_EQ(checker->clearance(at(setup, -1.5, 0, 0).get()), 0);
  EXPECT_NEAR(checker->clearance(at(setup, -4, 0, 0).get()), 2.5, 0.1);  // a turn brings it a little nearer
  EXPECT_LT(checker->clearance(at(setup, -1, 0, 0).get()), 0);
  // Upright it is 0.1 away where turns do not count, and nearer where they do.
  const Scoped upright = at(setup, -1, 0, std::numbers::pi / 2);
  const for_ompl::ExactValidityChecker straight(si, scene, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(straight.clearance(upright.get()), 0.1, 1e-9);
  EXPECT_LT(checker->clearance(upright.get()), 0.06);
}

TEST_F(OmplAdapter, from_inside_the_way_out_is_told) {
  const auto scene = scene_with_wall(0.5);
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setup();
  Scoped valid(setup.getStateSpace());
  bool available = false;
  const for_ompl::ExactValidityChecker straight(setup.getSpaceInformation(), scene,
                                                std::numeric_limits<double>::infinity());
  EXPECT_NEAR(straight.clearance(at(setup, -1.25, 0, 0).get(), valid.get(), available), -0.25, 1e-9);
  ASSERT_TRUE(available);  // a position at the wall, which doubles meet here
  EXPECT_EQ(valid->getX(), -1.5);
  EXPECT_TRUE(setup.getSpaceInformation()->isValid(valid.get()));
}

TEST_F(OmplAdapter, the_last_valid_state_is_never_behind_a_contact) {
  const auto scene = scene_with_wall(0.02);
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const PlainCollision plain(scene->robot(), scene->obstacle());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> position(-48, 48), angle(-std::numbers::pi, std::numbers::pi);
  Scoped last(setup.getStateSpace()), sample(setup.getStateSpace());
  int blocked = 0, free = 0;
  for (int k = 0; k < 300; ++k) {
    const Scoped a = at(setup, position(random), position(random), angle(random));
    const Scoped b = at(setup, position(random), position(random), angle(random));
    if (!si->isValid(a.get())) continue;
    std::pair<ob::State*, double> decided(last.get(), -1);
    const bool valid = si->checkMotion(a.get(), b.get(), decided);
    EXPECT_EQ(valid, si->checkMotion(a.get(), b.get()));
    (valid ? free : blocked)++;
    if (valid) {
      EXPECT_EQ(decided.second, -1) << "left as it was";
      decided.second = 1;
    } else {
      EXPECT_GE(decided.second, 0);
      EXPECT_LT(decided.second, 1);
      EXPECT_TRUE(si->isValid(last.get()));
    }
    for (int step = 0; step <= 100; ++step) {
      si->getStateSpace()->interpolate(a.get(), b.get(), decided.second * step / 100, sample.get());
      EXPECT_FALSE(plain.overlaps(for_ompl::configuration_of(sample.get()))) << "pair " << k << ", share " << step;
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
  EXPECT_EQ(si->getMotionValidator()->getValidMotionCount(), 2U * static_cast<unsigned>(free));
}

TEST_F(OmplAdapter, no_path_of_a_sampling_planner_collides) {
  int ours = 0, theirs = 0;
  for (const Validator validator : {Validator::certified, Validator::of_samples}) {
    const auto scene = scene_with_wall(0.02);
    const PlainCollision plain(scene->robot(), scene->obstacle());
    for (int k = 0; k < 10; ++k) {
      og::SimpleSetup setup = wall_problem(scene, validator);
      setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
      ASSERT_EQ(setup.solve(20.0), ob::PlannerStatus::EXACT_SOLUTION);
      (validator == Validator::certified ? ours : theirs) += collides(setup.getSolutionPath(), plain);
    }
  }
  EXPECT_EQ(ours, 0);
  EXPECT_GT(theirs, 0) << "the wall is too thick to tell";
}

TEST_F(OmplAdapter, the_planner_finds_a_path_that_ompl_can_follow) {
  const auto scene = scene_with_wall(0.02);
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setPlanner(std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene));
  ASSERT_EQ(setup.solve(20.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_TRUE(setup.haveExactSolutionPath());
  const og::PathGeometric& path = setup.getSolutionPath();
  EXPECT_TRUE(path.check());
  EXPECT_FALSE(collides(path, PlainCollision(scene->robot(), scene->obstacle())));
  const auto objective = std::make_shared<ob::MaximizeMinClearanceObjective>(setup.getSpaceInformation());
  EXPECT_GT(path.cost(objective).value(), 0);
}

TEST_F(OmplAdapter, the_planner_proves_that_there_is_no_path) {
  Ring closed = {{-50, -50}, {-50, 50}, {-0.5, 50}, {-0.5, -50}}, other = {{0.5, -50}, {0.5, 50}, {50, 50}, {50, -50}};
  const Region two_rooms =
      Region::create({{{{{-60, -60}, {60, -60}, {60, 60}, {-60, 60}}, {closed, other}}}, {}, {}}).value();
  const auto scene = for_ompl::Scene::create(robot_of_walls(), two_rooms).value();
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  const auto planner = std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene);
  setup.setPlanner(planner);
  EXPECT_EQ(setup.solve(20.0), ob::PlannerStatus::ABORT);
  EXPECT_TRUE(planner->proved_infeasible());
  EXPECT_FALSE(planner->why().empty());
}

TEST_F(OmplAdapter, a_path_out_of_bounds_is_no_solution) {
  const auto scene = for_ompl::Scene::create(robot_of_walls(), wall_without_a_room()).value();
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  const auto planner = std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene);
  setup.setPlanner(planner);
  EXPECT_EQ(setup.solve(20.0), ob::PlannerStatus::ABORT);
  EXPECT_FALSE(planner->proved_infeasible());
  EXPECT_NE(planner->why().find("bounds"), std::string::npos) << planner->why();
}

TEST_F(OmplAdapter, free_states_out_of_bounds_are_not_valid) {
  const auto scene = for_ompl::Scene::create(robot_of_walls(), wall_without_a_room()).value();
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  EXPECT_TRUE(si->isValid(at(setup, -50, 0, 0).get()));
  EXPECT_FALSE(si->isValid(at(setup, std::nextafter(-50, -51), 0, 0).get()));
  EXPECT_FALSE(si->checkMotion(at(setup, -49, 0, 0).get(), at(setup, -51, 0, 0).get()));
}

TEST_F(OmplAdapter, the_planner_turns_the_way_that_is_free) {
  // A bar turns about its end; a post bars the way through angle 0, so it turns through pi, past OMPL's seam.
  const Region bar = Region::create({{{{{-0.1, -0.1}, {2, -0.1}, {2, 0.1}, {-0.1, 0.1}}, {}}}, {}, {}}).value();
  const Ring room = {{-2.9, -2.9}, {-2.9, 2.9},  {2.9, 2.9},  {2.9, 0.6},
                     {-0.5, 0.6},  {-0.5, -0.6}, {2.9, -0.6}, {2.9, -2.9}};
  const Region walls = Region::create({{{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, {room}}}, {}, {}}).value();
  const auto scene = for_ompl::Scene::create(bar, walls).value();
  for (const double from : {1.5, -1.5, 1.6, -1.6}) {
    og::SimpleSetup setup = wall_problem(scene, Validator::certified);
    setup.setStartAndGoalStates(at(setup, -0.8, 0, from), at(setup, -0.8, 0, -from));
    setup.setPlanner(std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene));
    ASSERT_EQ(setup.solve(20.0), ob::PlannerStatus::EXACT_SOLUTION);
    EXPECT_TRUE(setup.getSolutionPath().check());
  }
}

TEST_F(OmplAdapter, a_path_that_only_touches_is_no_solution) {
  // A channel exactly as wide as the robot: there is a path that touches, and no state space can prove it free.
  const Ring rooms = {{-30, -30}, {-30, 10}, {-10, 10}, {-10, -19.5}, {10, -19.5},  {10, 10},
                      {30, 10},   {30, -30}, {10, -30}, {10, -20.5},  {-10, -20.5}, {-10, -30}};
  const Region walls = Region::create({{{{{-40, -40}, {40, -40}, {40, 40}, {-40, 40}}, {rooms}}}, {}, {}}).value();
  const auto scene = for_ompl::Scene::create(
                         Region::create({{{{{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}}, {}}}, {}, {}}).value(), walls)
                         .value();
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  const auto planner = std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene);
  setup.setPlanner(planner);
  EXPECT_EQ(setup.solve(20.0), ob::PlannerStatus::ABORT);
  EXPECT_TRUE(planner->proved_infeasible()) << planner->why();
  planner->set_touching(Touching::allowed);
  setup.clear();
  EXPECT_EQ(setup.solve(20.0), ob::PlannerStatus::ABORT);
  EXPECT_FALSE(planner->proved_infeasible()) << planner->why();
}

TEST_F(OmplAdapter, samplers_use_the_clearance) {
  const auto scene = scene_with_wall(0.5);
  og::SimpleSetup setup = wall_problem(scene, Validator::certified);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  ob::MinimumClearanceValidStateSampler far(si.get());
  far.setMinimumObstacleClearance(3);
  ob::MaximizeClearanceValidStateSampler better(si.get());
  Scoped state(setup.getStateSpace());
  for (int k = 0; k < 50; ++k) {
    if (far.sample(state.get())) {
      EXPECT_GE(setup.getStateValidityChecker()->clearance(state.get()), 3);
    }
    if (better.sample(state.get())) {
      EXPECT_TRUE(si->isValid(state.get()));
    }
  }
}

}  // namespace
}  // namespace dymsum::sampling
