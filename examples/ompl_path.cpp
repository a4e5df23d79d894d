// A path of a bar round a thin wall with OMPL: found by a sampling planner whose motions are proved free, and by
// dymsum's own.
#include <dymsum/dymsum.h>
#include <dymsum/ompl.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <iostream>

namespace ob = ompl::base;

int main() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  using namespace dymsum;
  const Region bar = shapes::rectangle(-1, -0.4, 1, 0.4);  // turns about the origin of its coordinates
  const Ring room = {{-9, -9}, {-9, 9}, {9, 9}, {9, -9}, {0.01, -9}, {0.01, 5}, {-0.01, 5}, {-0.01, -9}};
  const Region walls = Region::create({{{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, {room}}}, {}, {}}).value();
  const auto scene = for_ompl::Scene::create(bar, walls).value();

  const auto space = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(-9);
  bounds.setHigh(9);
  space->setBounds(bounds);
  ompl::geometric::SimpleSetup setup(space);
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<for_ompl::ExactValidityChecker>(si, scene));
  si->setMotionValidator(std::make_shared<for_ompl::CertifiedMotionValidator>(si, scene));

  ob::ScopedState<ob::SE2StateSpace> start(space), goal(space);
  start->setXY(-4, -4);
  start->setYaw(0);
  goal->setXY(4, -4);
  goal->setYaw(1.5);
  setup.setStartAndGoalStates(start, goal);

  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(si));
  std::cout << "RRTConnect: " << setup.solve(10.0).asString() << ", free: " << setup.getSolutionPath().check() << "\n";
  setup.clear();
  setup.setPlanner(std::make_shared<for_ompl::ExactPlanner>(si, scene));
  std::cout << "dymsum: " << setup.solve(10.0).asString() << ", free: " << setup.getSolutionPath().check()
            << ", clearance at the goal " << setup.getStateValidityChecker()->clearance(goal.get()) << "\n";
}
