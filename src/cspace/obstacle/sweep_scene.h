// What the stages at one angle of the sweep read: the pair, the boundary before the angle, and the angle itself.
#pragma once

#include <optional>

#include "cspace/boundary/boundary_graph.h"
#include "cspace/events/exact_position.h"
#include "cspace/events/quarter_turn.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

struct SweepScene {
  const TurningForms& forms;
  const RotationCatalog& catalog;
  const BoundaryGraph& graph;
};

/// An angle in doubles, and exactly once its signs are requested.
class AngleNow {
 public:
  explicit AngleNow(const TurningForms& forms) : forms_(forms) {}
  /// `crowded`: null unless it is a crowded quarter turn.
  void begin(double theta, const QuarterTurn* crowded) {
    theta_ = theta;
    crowded_ = crowded;
    exact_.reset();
    signs_.reset();
  }
  void set_exact(ExactAngle angle, double theta) {
    theta_ = theta;
    exact_ = std::move(angle);
  }
  double theta() const { return theta_; }
  Heading heading() const { return Heading::of(theta_); }
  const QuarterTurn* crowded() const { return crowded_; }
  /// Requires set_exact().
  const SignsAt& signs() const {
    if (!signs_) signs_.emplace(forms_, exact_.value());
    return *signs_;
  }

 private:
  const TurningForms& forms_;
  double theta_ = 0;
  const QuarterTurn* crowded_ = nullptr;
  std::optional<ExactAngle> exact_;
  mutable std::optional<SignsAt> signs_;
};

}  // namespace dymsum::planar
