/// \file
/// States of a robot, exactly: valid or not, with clearance.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <cmath>
#include <memory>
#include <utility>

#include "dymsum/ompl/scene.h"

namespace dymsum::for_ompl {

/// Valid: within the bounds of the space, and the interiors of robot and obstacle do not meet; the answer is exact for
/// the doubles of the state (ObstacleQueries::contains). Thread-safe.
class ExactValidityChecker : public ::ompl::base::StateValidityChecker {
 public:
  /// `weight` is a length per radian: clearance is measured with dx^2 + dy^2 + weight^2 dtheta^2. Without one it is the
  /// robot's radius of gyration.
  ExactValidityChecker(const ::ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene)
      : ExactValidityChecker(si, scene, scene->queries().gyration_radius()) {}
  ExactValidityChecker(const ::ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene, double weight)
      : StateValidityChecker(si), scene_(std::move(scene)), weight_(weight) {
    specs_.clearanceComputationType = ::ompl::base::StateValidityCheckerSpecs::EXACT;
    specs_.hasValidDirectionComputation = true;
  }

  using StateValidityChecker::clearance;
  using StateValidityChecker::isValid;

  bool isValid(const ::ompl::base::State* state) const override {
    return si_->satisfiesBounds(state) && is_finite(state) && !scene_->queries().contains(configuration_of(state));
  }

  /// The distance to the nearest contact, negative inside the obstacle: minus the penetration depth. The sign is exact,
  /// the magnitude certified to about 1e-9 of itself (Clearance::error); bounds of the space are no contacts.
  double clearance(const ::ompl::base::State* state) const override {
    return scene_->queries().clearance(configuration_of(state), weight_).distance;
  }

  /// The same; `valid` is the nearest contact itself, where that is a valid state in doubles.
  double clearance(const ::ompl::base::State* state, ::ompl::base::State* valid, bool& available) const override {
    const Clearance found = scene_->queries().clearance(configuration_of(state), weight_);
    auto* se2 = valid->as<::ompl::base::SE2StateSpace::StateType>();
    se2->setXY(found.nearest.x, found.nearest.y);
    se2->setYaw(found.nearest.theta);
    si_->enforceBounds(valid);
    available = isValid(valid);
    return found.distance;
  }

 private:
  static bool is_finite(const ::ompl::base::State* state) {
    const Configuration c = configuration_of(state);
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.theta);
  }

  std::shared_ptr<const Scene> scene_;
  double weight_;
};

}  // namespace dymsum::for_ompl
