// A wall between a robot and its goal, thinner than the samples of OMPL's own motion validator are apart.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <memory>
#include <numbers>
#include <vector>

#include "dymsum/ompl.h"
#include "ompl/plain_collision.h"

namespace dymsum::sampling {

/// A room of 100 by 100 with a wall of this half thickness that leaves a passage of 10 at its end; a robot of 2 by 0.8.
inline Region room_with_wall(double half) {
  Ring inside = {{-50, -50}, {-50, 50}, {50, 50}, {50, -50}, {half, -50}, {half, 40}, {-half, 40}, {-half, -50}};
  return Region::create({{{{{-60, -60}, {60, -60}, {60, 60}, {-60, 60}}, {inside}}}, {}, {}}).value();
}
inline Region robot_of_walls() {
  return Region::create({{{{{-1, -0.4}, {1, -0.4}, {1, 0.4}, {-1, 0.4}}, {}}}, {}, {}}).value();
}
inline std::shared_ptr<const for_ompl::Scene> scene_with_wall(double half) {
  return for_ompl::Scene::create(robot_of_walls(), room_with_wall(half)).value();
}

enum class Validator { of_samples, certified };

/// From one side of the wall to the other.
inline ::ompl::geometric::SimpleSetup wall_problem(const std::shared_ptr<const for_ompl::Scene>& scene,
                                                   Validator validator) {
  namespace ob = ::ompl::base;
  const auto space = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(-50);
  bounds.setHigh(50);
  space->setBounds(bounds);
  ::ompl::geometric::SimpleSetup setup(space);
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<for_ompl::ExactValidityChecker>(si, scene));
  if (validator == Validator::certified)
    si->setMotionValidator(std::make_shared<for_ompl::CertifiedMotionValidator>(si, scene));
  ob::ScopedState<ob::SE2StateSpace> start(space), goal(space);
  start->setXY(-20, -20);
  goal->setXY(20, -20);
  start->setYaw(0);
  goal->setYaw(0);
  setup.setStartAndGoalStates(start, goal);
  return setup;
}

/// Whether a path collides at one of 20,000 points of it, determined by doubles that share nothing with the library.
inline bool collides(const ::ompl::geometric::PathGeometric& path, const PlainCollision& plain) {
  ::ompl::geometric::PathGeometric fine(path);
  fine.interpolate(20000);
  for (std::size_t k = 0; k < fine.getStateCount(); ++k)
    if (plain.overlaps(for_ompl::configuration_of(fine.getState(k)))) return true;
  return false;
}

}  // namespace dymsum::sampling
