// The state behind a RotatingSum: the window of angles, its frame and loops.
#pragma once

#include <map>
#include <memory>

#include "dymsum/rotating_sum.h"
#include "planar/frames/moving_sum.h"
#include "planar/rotating/turned_rings.h"

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
  /// What frames inside the window look at.
  struct Frames {
    Frames(planar::RotatingWindow w, const planar::OperandPair& base, bool swapped, bool moving_turns)
        : window(std::move(w)), frame(window), rings(base, window, swapped, moving_turns) {}
    planar::RotatingWindow window;
    planar::RotatingFrame frame;
    planar::TurnedRings rings;
  };
  planar::PlacedPair placed() const override;
  bool build_window(const Move& move, const planar::WindowController::Choice& reach) override;
  void drop_window() override;
  bool has_window() const override { return frames_ != nullptr; }
  std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) override;
  double cost_of(const FrameWork& work) override;
  WindowCost cost_of_window() const override;

  /// The turn of the moving operand in the frame in which the other one rests.
  double moving_angle(const Orientation& theta) const { return (swapped_ == p_turns() ? 1 : -1) * theta.radians(); }
  bool p_turns() const { return options.moving == MovingOperand::p; }
  double widest_window() const;
  double extent() const;
  int cells_for(double half) const;
  void assemble(NextFrame& next);

  std::shared_ptr<const planar::OperandPair> base_;        // P is operand 0
  std::shared_ptr<const planar::OperandPair> forms_base_;  // the moving operand is operand 1: the smaller one
  bool swapped_ = false;                                   // that is P
  std::unique_ptr<planar::TurningForms> forms_;            // none: every frame is a rebuild
  std::unique_ptr<planar::TurnCatalog> catalog_;
  std::map<int, std::unique_ptr<planar::TurnGrid>> grids_;  // by cells
  double segments_ = 0;                                     // of the reduced convolution, about
  double slice_cost_ = 0;                                   // of the last frame from scratch
  Orientation theta_;                                       // the new position, during a move
  std::unique_ptr<Frames> frames_;
  std::unique_ptr<planar::RotatingLoops> loops_;
};

namespace planar {

struct RotatingInternals {
  using State = RotatingSum::State;
};
using RotatingState = RotatingInternals::State;

}  // namespace planar
}  // namespace dymsum
