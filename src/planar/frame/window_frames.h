// A window of scales with all that frames inside it know; its loops as rings of a sum.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "planar/frame/frame_loops.h"
#include "planar/motion/exact_frame.h"
#include "planar/position/exact_source.h"
#include "planar/window/frame_window.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {

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
