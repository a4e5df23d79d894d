// The state behind a ScalingSum: the window of scales in which frames are made, those that were left, and the next one.
#pragma once

#include <memory>

#include "dymsum/scaling_sum.h"
#include "planar/frames/moving_sum.h"
#include "planar/scaling/kept_windows.h"
#include "planar/scaling/window_ahead.h"
#include "planar/scaling/window_builder.h"

namespace dymsum {

class ScalingSum::State final : public planar::MovingSum {
 public:
  State(std::shared_ptr<const planar::OperandPair> base, MovingOptions options)
      : MovingSum(std::move(options)), base(base), windows(std::move(base)) {
    controller_ = planar::WindowController(kFirstFrames, kFirstWidth, kFactor, kPayback);
  }

  /// Moves to diag(x, y). Changes nothing on an error.
  Result<FrameChanges> move_to(const Scale& x, const Scale& y);

  std::shared_ptr<const planar::OperandPair> base;
  planar::WindowBuilder windows;
  Scale scale, scale_y;
  /// For tests: what is kept, and waits until the window that is under way is ready.
  const planar::KeptWindows& kept_windows() const { return kept_; }
  void finish_window_ahead();

 private:
  /// Of the first window: where steps are small it is not narrower for that, as building costs nearly as much.
  static constexpr double kFirstFrames = 160, kFirstWidth = 0.08, kFactor = 1.2, kPayback = 8;

  planar::PlacedPair placed() const override;
  bool awaits_window(const Move& move) const override;
  bool build_elsewhere(const Move& move, const planar::WindowController::Choice& reach) override;
  bool build_window(const Move& move, const planar::WindowController::Choice& reach) override;
  void drop_window() override { leave_window(); }
  void abandon_window() override { frames_.reset(); }
  bool has_window() const override { return frames_ != nullptr; }
  std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) override;
  double cost_of(const FrameWork& work) override;
  WindowCost cost_of_window() const override;
  NextFrame assemble(double tau, planar::ExactFrame& frame, bool stays);

  bool makes_ahead() const { return options.threads > 1 && chooses(); }
  void leave_window();
  void enter_window();
  void take_window_ahead();
  void start_ahead(planar::WindowPlan plan, double entry, double step);
  void make_next_window(double step, double widest);
  planar::WindowPlan plan(double low, double high, double at);
  planar::WindowPlan plan_from(const Move& move, const planar::WindowController::Choice& reach);

  planar::ScaleValue x_, y_;  ///< the new position, during a move
  std::unique_ptr<planar::WindowFrames> frames_;
  const planar::WindowFrames* last_ = nullptr;  ///< where the last frame was made, if in a window
  planar::KeptWindows kept_;
  std::unique_ptr<planar::WindowFrames> made_ahead_;
  bool too_expensive_ahead_ = false;  ///< the next window was abandoned, and none has been entered since
  double step_ahead_ = 0;             ///< that the window under way was started at
  planar::WindowAhead ahead_;
};

namespace planar {

struct ScalingInternals {
  using State = ScalingSum::State;
};
using ScalingState = ScalingInternals::State;

}  // namespace planar
}  // namespace dymsum
