// The state behind a ScalingSum: windows of scales and the frames inside them.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "planar/frame/moving_sum.h"
#include "planar/frame/window_frames.h"
#include "planar/window/window_builder.h"

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
  planar::WindowBuilder windows;  ///< of uniform scales
  Scale scale, scale_y;

 private:
  struct ScaleMove : Move {
    planar::ScaleValue x, y;                           ///< the new position
    planar::ScaleValue s;                              ///< the same as windows have it: the larger of both
    planar::WindowBuilder* builder = nullptr;          ///< of windows at the new position, where they serve
    std::shared_ptr<const planar::OperandPair> swept;  ///< the operands these are of
  };
  static const ScaleMove& scaling(const Move& move) { return static_cast<const ScaleMove&>(move); }

  /// The first window is not narrower where steps are small, as building costs nearly as much.
  static constexpr double kFirstFrames = 160, kFirstWidth = 0.08, kFactor = 1.2, kPayback = 8;

  planar::PlacedPair placed(const Move& move) const override;
  planar::MakeWindow window_for(const Move& move, const planar::WindowController::Choice& reach) override;
  planar::MakeWindow window_from(double end, const Move& move, double width) override;
  void window_changes(planar::FrameWindow*) override { last_ = nullptr; }
  std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) override;
  double cost_of(const FrameWork& work) override;
  double cost_of_window() const override;
  NextFrame assemble(const ScaleMove& move, double tau, planar::ExactFrame& frame);

  planar::MakeWindow maker(const ScaleMove& move, double low, double high, double entry);
  planar::WindowFrames& frames() const { return static_cast<planar::WindowFrames&>(*window()); }

  ScaleMove move_of(const Scale& x, const Scale& y);
  planar::RatioSweep* ratio_sweep(const planar::Factors& factors, bool make);
  void remember_touching(const Scale& x, const Scale& y);

  planar::Factors factors_;  ///< of the last position
  planar::RatioSweeps ratios_;
  std::vector<std::array<Scale, 2>> touching_;  ///< where frames from scratch found that something touches
  const planar::WindowFrames* last_ = nullptr;  ///< where the last frame was made, if in a window
};

namespace planar {

struct ScalingInternals {
  using State = ScalingSum::State;
};
using ScalingState = ScalingInternals::State;

}  // namespace planar
}  // namespace dymsum
