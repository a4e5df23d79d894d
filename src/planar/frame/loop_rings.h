// The loops of a window as rings of a sum, in input coordinates.
#pragma once

#include <functional>
#include <vector>

#include "planar/frame/frame_loops.h"
#include "planar/motion/exact_frame.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

class LoopRings {
 public:
  struct Rings {
    std::vector<SumRing> rings;  ///< each from its smallest vertex on
    std::vector<std::uint8_t> outer;
    std::vector<FrameLoop*> loops;
    double at_error = 0;
  };
  explicit LoopRings(FrameLoops& loops) : loops_(loops) {}

  /// The kept loops at tau. `spare` gives storage for a ring.
  Rings at(double tau, const Window& window, const ExactFrame& frame, const ExactSource& source,
           const std::function<SumRing()>& spare);

 private:
  std::size_t likely_start(const FrameLoop& loop) const;
  void lead(std::vector<std::uint32_t> leaders);

  FrameLoops& loops_;
  std::vector<std::uint32_t> leaders_;  ///< vertices at which the last frame's rings started,
  std::vector<std::uint8_t> leads_;     ///< and whether a vertex is one of these
};

}  // namespace dymsum::planar
