// The state behind a ScalingSum: windows of scales and the frames inside them.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "planar/frame/frame_loops.h"
#include "planar/frame/moving_sum.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"
#include "planar/window/frame_window.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {

// A window of scales with all that frames inside it know; its loops as rings of a sum.

/// The rings of loops in input coordinates.
class LoopRings {
 public:
  explicit LoopRings(FrameLoops& loops) : loops_(loops) {}

  /// The kept loops at tau. `spare` gives storage for a ring.
  KeptRings at(double tau, const Window& window, const ExactFrame& frame, const ExactSource& source,
               const std::function<SumRing()>& spare);

 private:
  std::size_t likely_start(const FrameLoop& loop) const;
  void lead(std::vector<std::uint32_t> leaders);

  FrameLoops& loops_;
  std::vector<std::uint32_t> leaders_;  ///< vertices at which the last frame's rings started,
  std::vector<std::uint8_t> leads_;     ///< and whether a vertex is one of these
};

struct WindowFrames final : FrameWindow {
  WindowFrames(std::uint64_t family, std::shared_ptr<const OperandPair> base, double low, double high,
               std::shared_ptr<const ReducedConvolution> convolution, std::unique_ptr<Window> window)
      : FrameWindow(family),
        base(std::move(base)),
        low(low),
        high(high),
        convolution(std::move(convolution)),
        window(std::move(window)) {}

  std::shared_ptr<const OperandPair> base;  // outlives the window
  double low = 0, high = 0;                 ///< scales the window covers
  std::shared_ptr<const ReducedConvolution> convolution;
  std::unique_ptr<Window> window;
  PieceLists lists{*window};
  FrameLoops loops{lists};
  LoopRings rings{loops};
  bool known = false;  ///< the loops are those of the last frame that was made here

  bool covers(double s) const override { return s > low && s < high; }
  double end(bool up) const override { return up ? high : low; }
  std::size_t bytes() const override { return window->bytes() + lists.bytes() + loops.bytes(); }
  /// Brings lists and loops to a scale inside. False where something touches there that needs the vertex routine, and
  /// then nothing is known.
  bool follow(ExactFrame& frame, FrameWork& work) {
    const double tau = frame.tau(window->frame().moving);
    known = lists.repair(tau, frame, work) && loops.update(tau, frame, !known, work);
    if (!known) loops.loops().clear();
    return known;
  }
};

/// Nothing where it is abandoned.
std::unique_ptr<WindowFrames> window_frames(const WindowPlan& plan);

/// A frame at which something touches: the sum at a scale that the window covers, by the static engine on the window's
/// segments and pairs. Cost: O(pieces + candidates), and the vertex routine.
PlanarSum degenerate_frame(const Window& window, const ReducedConvolution& convolution, ExactFrame& frame,
                           Semantics semantics);

}  // namespace dymsum::planar

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
