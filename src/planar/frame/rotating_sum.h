// The state behind a RotatingSum: windows of angles, the frames inside them, their loops, and these as rings.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/rotating_sum.h"
#include "planar/frame/moving_sum.h"
#include "planar/frame/rotating_loops.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {

/// The loops of a frame as rings of a sum, in input coordinates. Of one window at a time.
class TurnedRings {
 public:
  /// `swapped`: P is the moving operand, operand 1 of the forms. `moving_turns`: the moving operand rotates in the sum;
  /// otherwise what it stands against does.
  TurnedRings(const OperandPair& forms_base, const TurningForms& forms, bool swapped, bool moving_turns)
      : base_(forms_base), forms_(forms), swapped_(swapped), moving_turns_(moving_turns) {}
  /// Loops are those of frames in this window from now on.
  void enter(const RotatingWindow& window);

  std::size_t bytes() const { return bytes_of(names_, corners_); }
  /// The kept loops; `source` knows their exact positions, `spare` gives storage for a ring.
  KeptRings at(const Orientation& theta, const RotatingFrame& frame, RotatingLoops& loops, const ExactSource& source,
               const std::function<SumRing()>& spare);

 private:
  /// Takes the coordinates of the forms to those of the sum: they may be rotated, scaled and moved, in this order, as
  /// what is small may be subnormal.
  struct Rigid {
    double c = 1, s = 0, unit = 1;
    Point by;
    Point operator()(double x, double y) const {
      return {(c * x - s * y) * unit + by.x, (s * x + c * y) * unit + by.y};
    }
  };
  /// How the sum names a segment and its end.
  struct Names {
    Contact contact;
    std::uint32_t corner_p = 0, corner_q = 0;
  };
  Rigid to_sum(const Orientation& theta) const;
  double input_error(double error) const;
  const Names& names(std::uint32_t segment);

  const OperandPair& base_;
  const TurningForms& forms_;
  bool swapped_, moving_turns_;
  const RotatingWindow* window_ = nullptr;
  std::vector<Names> names_;            // of segments, made when first requested
  std::vector<std::uint32_t> corners_;  // scratch: the steps of a ring that end at its vertices
};

}  // namespace dymsum::planar

namespace dymsum {

class RotatingSum::State final : public planar::MovingSum {
 public:
  /// `forms_base`: the same operands, the smaller one, which moves in windows, as operand 1.
  State(std::shared_ptr<const planar::OperandPair> base, std::shared_ptr<const planar::OperandPair> forms_base,
        const MovingOptions& options);
  /// Whether windows can serve at all; otherwise there is no need of `forms_base`.
  static bool has_windows(const planar::OperandPair& base);
  static bool p_is_smaller(const planar::OperandPair& base);

  /// Changes nothing on an error.
  Result<FrameChanges> move_to(const Orientation& theta);

  Orientation orientation;

 private:
  struct TurnMove : Move {
    Orientation theta;  ///< the new position
  };
  static const Orientation& theta_of(const Move& move) { return static_cast<const TurnMove&>(move).theta; }

  using Grids = std::map<int, std::unique_ptr<planar::RotationGrid>>;  ///< by cells

  planar::PlacedPair placed(const Move& move) const override;
  planar::MakeWindow window_for(const Move& move, const planar::WindowController::Choice& reach) override;
  planar::MakeWindow window_from(double end, const Move& move, double width) override;
  void window_changes(planar::FrameWindow* next) override;
  std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) override;
  double cost_of(const FrameWork& work) override;
  double cost_of_window() const override;

  /// The turn of the moving operand in the frame in which the other one rests.
  double moving_angle(const Orientation& theta) const { return (swapped_ == p_turns() ? 1 : -1) * theta.radians(); }
  bool p_turns() const { return options.moving == MovingOperand::p; }
  double widest_window() const;
  double extent() const;
  int cells_for(double half) const;
  double reach_back(const Move& move) const;
  planar::MakeWindow maker(double low, double high);
  const planar::TurnedWindow& turned() const { return static_cast<const planar::TurnedWindow&>(*window()); }
  const planar::TurningForms& forms() const { return operands_->forms; }
  void assemble(const Orientation& theta, NextFrame& next);

  std::shared_ptr<const planar::OperandPair> base_;         // P is operand 0
  bool swapped_ = false;                                    // P is the smaller operand, which moves in windows
  std::shared_ptr<const planar::TurnedOperands> operands_;  // none: every frame is a rebuild
  std::shared_ptr<Grids> grids_;                            // used by one window at a time, on any thread
  double segments_ = 0;                                     // of the reduced convolution, about
  double slice_cost_ = 0;                                   // of the last frame from scratch
  planar::RotatingFrame frame_;                             // in the current window
  std::unique_ptr<planar::RotatingLoops> loops_;
  std::unique_ptr<planar::TurnedRings> rings_;
};

namespace planar {

struct RotatingInternals {
  using State = RotatingSum::State;
};
using RotatingState = RotatingInternals::State;

}  // namespace planar
}  // namespace dymsum
