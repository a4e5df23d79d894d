/// \file
/// Motions between states that are free in every point, not only at samples.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/util/Exception.h>

#include <memory>
#include <utility>

#include "dymsum/motion.h"
#include "dymsum/ompl/scene.h"

namespace dymsum::for_ompl {

/// A motion is valid if it is proved free as OMPL interpolates it, x, y and theta linear in time: by check_motion. What
/// is closer to a touch than its resolution tells counts as invalid, so that nothing is ever believed free that is not.
class CertifiedMotionValidator : public ::ompl::base::MotionValidator {
 public:
  CertifiedMotionValidator(const ::ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene,
                           const MotionOptions& options = {})
      : MotionValidator(si), scene_(std::move(scene)), options_(options) {}

  bool checkMotion(const ::ompl::base::State* from, const ::ompl::base::State* to) const override {
    return counted(si_->isValid(to) && check(from, to).outcome == MotionCheck::Outcome::free);
  }

  /// A motion that is not valid has its last valid state where what is proved free ends, never behind a contact.
  bool checkMotion(const ::ompl::base::State* from, const ::ompl::base::State* to,
                   std::pair<::ompl::base::State*, double>& last) const override {
    const MotionCheck found = check(from, to);
    const bool free = found.outcome == MotionCheck::Outcome::free && si_->isValid(to);
    if (!free) set_last(from, to, found.low, last);
    return counted(free);
  }

 private:
  MotionCheck check(const ::ompl::base::State* from, const ::ompl::base::State* to) const {
    const Configuration a = configuration_of(from);
    const Result<MotionCheck> found =
        check_motion(scene_->robot(), scene_->obstacle(), a, reached_from(a, configuration_of(to)), options_);
    if (!found) throw ::ompl::Exception(found.error().to_string());
    return *found;
  }

  /// The way is free before `fraction`; the state there may touch, and is rounded.
  void set_last(const ::ompl::base::State* from, const ::ompl::base::State* to, double fraction,
                std::pair<::ompl::base::State*, double>& last) const {
    ::ompl::base::State* state = si_->allocState();
    if (fraction >= 1) fraction = 1 - 0x1p-20;  // free, but the end is out of bounds
    for (si_->getStateSpace()->interpolate(from, to, fraction, state); fraction > 0 && !si_->isValid(state);) {
      fraction = fraction > 0x1p-60 ? fraction * (1 - 0x1p-10) - 0x1p-60 : 0;
      if (fraction < 0) fraction = 0;
      si_->getStateSpace()->interpolate(from, to, fraction, state);
    }
    last.second = fraction;
    if (last.first != nullptr) si_->copyState(last.first, fraction > 0 ? state : from);
    si_->freeState(state);
  }

  bool counted(bool free) const {
    free ? ++valid_ : ++invalid_;
    return free;
  }

  std::shared_ptr<const Scene> scene_;
  MotionOptions options_;
};

}  // namespace dymsum::for_ompl
