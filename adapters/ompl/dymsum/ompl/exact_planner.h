/// \file
/// dymsum's planner as one of OMPL's: it finds a path or proves that there is none.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/ompl/scene.h"
#include "dymsum/planner.h"

namespace dymsum::for_ompl {

/// Answers from the whole exact obstacle (`plan`). EXACT_SOLUTION: a path of translations and turns in place, every
/// piece of which, rounded to the doubles of its states, is proved free. ABORT: there is none, or none that the state
/// space can hold; `why` says which, and `proved_infeasible` whether it is a proof. TIMEOUT: the termination condition
/// became true. It takes all start states, and goals that can be sampled.
class ExactPlanner : public ::ompl::base::Planner {
 public:
  ExactPlanner(const ::ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene)
      : Planner(si, "dymsum"), scene_(std::move(scene)) {
    specs_.recognizedGoal = ::ompl::base::GOAL_SAMPLEABLE_REGION;
    specs_.provingSolutionNonExistence = true;
  }

  /// Whether the robot may touch the obstacle on its way. A path that touches is rarely free once it is rounded.
  void set_touching(Touching touching) { touching_ = touching; }

  ::ompl::base::PlannerStatus solve(const ::ompl::base::PlannerTerminationCondition& stop) override {
    checkValidity();
    clear_answer();
    if (dynamic_cast<::ompl::base::GoalSampleableRegion*>(pdef_->getGoal().get()) == nullptr)
      return ::ompl::base::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
    std::vector<const ::ompl::base::State*> starts;
    while (const ::ompl::base::State* start = pis_.nextStart()) starts.push_back(start);
    if (starts.empty()) return ::ompl::base::PlannerStatus::INVALID_START;
    const ::ompl::base::State* goal = pis_.nextGoal(stop);
    if (goal == nullptr) return stop ? ::ompl::base::PlannerStatus::TIMEOUT : ::ompl::base::PlannerStatus::INVALID_GOAL;
    for (; goal != nullptr; goal = pis_.nextGoal()) {
      for (const ::ompl::base::State* start : starts) {
        if (stop) return ::ompl::base::PlannerStatus::TIMEOUT;
        if (const auto status = connect(start, goal, stop); status != ::ompl::base::PlannerStatus::ABORT) return status;
      }
    }
    return ::ompl::base::PlannerStatus::ABORT;
  }

  void clear() override {
    Planner::clear();
    clear_answer();
  }

  /// After ABORT: the reason, for the last pair of a start and a goal.
  const std::string& why() const { return why_; }
  /// After ABORT: no pair of a start and a goal that was tried is joined, which is a proof where goals are finitely
  /// many.
  bool proved_infeasible() const { return proved_; }
  /// The work of the last search.
  const PlanWork& work() const { return work_; }

 private:
  void clear_answer() {
    why_.clear();
    proved_ = true;
    work_ = {};
  }

  ::ompl::base::PlannerStatus connect(const ::ompl::base::State* start, const ::ompl::base::State* goal,
                                      const ::ompl::base::PlannerTerminationCondition& stop) {
    PlanOptions options;
    options.touching = touching_;
    options.time_limit_seconds = std::numeric_limits<double>::infinity();
    options.progress = [&](std::string_view, double) { return !stop; };
    const Result<Plan> found = plan(scene_->cspace(), configuration_of(start), configuration_of(goal), options);
    if (!found) {
      if (found.error().code == ErrorCode::cancelled) return ::ompl::base::PlannerStatus::TIMEOUT;
      throw ::ompl::Exception(found.error().to_string());
    }
    work_ = found->work;
    if (!found->found()) return refuse(found->reason->text, found->reason->kind != NoPath::Kind::undecided);
    return publish(found->path, start, goal);
  }

  ::ompl::base::PlannerStatus refuse(std::string why, bool proof) {
    why_ = std::move(why);
    proved_ = proved_ && proof;
    return ::ompl::base::PlannerStatus::ABORT;
  }

  ::ompl::base::PlannerStatus publish(const std::vector<Waypoint>& path, const ::ompl::base::State* start,
                                      const ::ompl::base::State* goal) {
    const auto states = std::make_shared<::ompl::geometric::PathGeometric>(si_);
    states->append(start);
    for (std::size_t k = 1; k < path.size(); ++k) append(*states, path[k - 1], path[k]);
    si_->copyState(states->getStates().back(), path.size() > 1 ? goal : start);
    for (const ::ompl::base::State* state : states->getStates()) {
      if (!si_->satisfiesBounds(state))
        return refuse(
            "the path leaves the bounds of the space; walls that the robot may not pass belong to the obstacle", false);
    }
    for (std::size_t k = 1; k < states->getStateCount(); ++k) {
      const Configuration a = configuration_of(states->getState(k - 1));
      const Configuration b = reached_from(a, configuration_of(states->getState(k)));
      const Result<MotionCheck> piece = check_motion(scene_->robot(), scene_->obstacle(), a, b);
      if (!piece || piece->outcome != MotionCheck::Outcome::free)
        return refuse("there is a path, but rounded to doubles its piece " + std::to_string(k) + " is not proved free",
                      false);
    }
    pdef_->addSolutionPath(states, false, 0.0, getName());
    return ::ompl::base::PlannerStatus::EXACT_SOLUTION;
  }

  /// One piece of a path. Turns that are not the shorter way round are cut, so that OMPL's interpolation turns the same
  /// way.
  void append(::ompl::geometric::PathGeometric& states, const Waypoint& from, const Waypoint& to) const {
    double turn = to.approx.theta - from.approx.theta;
    if (to.move == Waypoint::Move::counter_clockwise && turn < 0) turn += 2 * std::numbers::pi;
    if (to.move == Waypoint::Move::clockwise && turn > 0) turn -= 2 * std::numbers::pi;
    const bool turns = to.move == Waypoint::Move::counter_clockwise || to.move == Waypoint::Move::clockwise;
    const int parts = turns ? 1 + static_cast<int>(std::abs(turn) * 1.5 / std::numbers::pi) : 1;
    ::ompl::base::State* state = si_->allocState();
    auto* se2 = state->as<::ompl::base::SE2StateSpace::StateType>();
    for (int part = 1; part <= parts; ++part) {
      const double theta = part == parts ? to.approx.theta : from.approx.theta + turn * part / parts;
      se2->setXY(to.approx.x, to.approx.y);
      se2->setYaw(theta);
      si_->getStateSpace()->as<::ompl::base::SE2StateSpace>()->getSubspace(1)->enforceBounds(
          se2->as<::ompl::base::SO2StateSpace::StateType>(1));
      states.append(state);
    }
    si_->freeState(state);
  }

  std::shared_ptr<const Scene> scene_;
  Touching touching_ = Touching::forbidden;
  std::string why_;
  bool proved_ = true;
  PlanWork work_;
};

}  // namespace dymsum::for_ompl
