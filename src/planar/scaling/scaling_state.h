// The state behind a ScalingSum: the window of scales, its lists and loops.
#pragma once

#include <memory>

#include "dymsum/scaling_sum.h"
#include "planar/frames/moving_sum.h"
#include "planar/scaling/loop_rings.h"
#include "planar/scaling/window_builder.h"

namespace dymsum {

class ScalingSum::State final : public planar::MovingSum {
 public:
  State(std::shared_ptr<const planar::OperandPair> base, MovingOptions options)
      : MovingSum(std::move(options)), base(base), windows(std::move(base)) {
    controller_ = planar::WindowController(kFirstFrames, kFirstWidth);
  }

  /// Moves to diag(x, y). Changes nothing on an error.
  Result<FrameChanges> move_to(const Scale& x, const Scale& y);

  std::shared_ptr<const planar::OperandPair> base;
  planar::WindowBuilder windows;
  Scale scale, scale_y;


 private:
  /// Of the first window: where steps are small it is not narrower for that, as building costs nearly as much.
  static constexpr double kFirstFrames = 160, kFirstWidth = 0.12;
  /// What frames inside the window look at.
  struct Frames {
    double low = 0, high = 0;  ///< scales the window covers
    std::shared_ptr<const planar::ReducedConvolution> convolution;
    std::unique_ptr<planar::Window> window;
    planar::PieceLists lists{*window};
    planar::FrameLoops loops{lists};
    planar::LoopRings rings{loops};
    bool known = false;  ///< the loops are those of the last frame
  };

  planar::PlacedPair placed() const override;
  bool build_window(const Move& move, const planar::WindowController::Choice& reach) override;
  void drop_window() override { frames_.reset(); }
  bool has_window() const override { return frames_ != nullptr; }
  std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) override;
  double cost_of(const FrameWork& work) override;
  WindowCost cost_of_window() const override;
  NextFrame assemble(double tau, planar::ExactFrame& frame, bool stays);

  planar::ScaleValue x_, y_;  ///< the new position, during a move
  std::unique_ptr<Frames> frames_;
};

namespace planar {

struct ScalingInternals {
  using State = ScalingSum::State;
};
using ScalingState = ScalingInternals::State;

}  // namespace planar
}  // namespace dymsum
