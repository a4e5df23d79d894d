/// \file
/// What the adapter's classes share: a robot, its obstacle for all angles, and the index for questions to it.
#pragma once

#include <ompl/base/spaces/SE2StateSpace.h>

#include <memory>
#include <numbers>
#include <utility>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/obstacle_queries.h"

namespace dymsum::for_ompl {

/// A robot among obstacles. The robot's reference point, which x and y of a state move, is the origin of its
/// coordinates, and it turns about it. OMPL's bounds limit the reference point; what the robot's body may not leave
/// belongs to the obstacle, as a frame of walls. Immutable: one scene may serve many planners and threads.
class Scene {
 public:
  /// Errors and cost: as CspaceObstacle::create.
  static Result<std::shared_ptr<const Scene>> create(const Region& robot, const Region& obstacle,
                                                     const ObstacleOptions& options = {}) {
    Result<CspaceObstacle> cspace = CspaceObstacle::create(robot, obstacle, options);
    if (!cspace) return cspace.error();
    return std::shared_ptr<const Scene>(new Scene(std::move(cspace).value()));
  }

  const Region& robot() const { return cspace_.robot(); }
  const Region& obstacle() const { return cspace_.obstacle(); }
  const CspaceObstacle& cspace() const { return cspace_; }
  const ObstacleQueries& queries() const { return queries_; }

 private:
  explicit Scene(CspaceObstacle cspace) : cspace_(std::move(cspace)), queries_(cspace_) {}
  CspaceObstacle cspace_;
  ObstacleQueries queries_;
};

/// A state of SE2StateSpace as a configuration.
inline Configuration configuration_of(const ::ompl::base::State* state) {
  const auto* se2 = state->as<::ompl::base::SE2StateSpace::StateType>();
  return {se2->getX(), se2->getY(), se2->getYaw()};
}

/// Where a motion that OMPL interpolates from `a` to `b` ends, as an angle at face value: it turns the shorter way, and
/// half a turn the way that the two angles say.
inline Configuration reached_from(const Configuration& a, Configuration b) {
  const double turn = b.theta - a.theta;
  if (turn > std::numbers::pi) b.theta -= 2 * std::numbers::pi;
  if (turn < -std::numbers::pi) b.theta += 2 * std::numbers::pi;
  return b;
}

}  // namespace dymsum::for_ompl
