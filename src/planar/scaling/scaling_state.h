// The state behind a ScalingSum: one window, its lists and loops, and the current frame.
#pragma once

#include <memory>
#include <unordered_map>

#include "dymsum/scaling_sum.h"
#include "planar/frames/controller.h"
#include "planar/frames/frame_rings.h"
#include "planar/position/vertex_order.h"
#include "planar/scaling/exact_forms.h"
#include "planar/scaling/frame_loops.h"
#include "planar/scaling/line_hashes.h"

namespace dymsum {

class ScalingSum::State {
 public:
  State(std::shared_ptr<const planar::OperandPair> base, ScalingOptions options)
      : base(std::move(base)), options(std::move(options)) {}

  /// Moves to diag(x, y). Changes nothing on an error.
  Result<FrameChanges> move_to(const Scale& x, const Scale& y);

  std::shared_ptr<const planar::OperandPair> base;
  ScalingOptions options;
  Scale scale, scale_y;
  PlanarSum sum;
  std::vector<std::uint64_t> ring_ids;
  FrameWork work;
  double shrink = 1;  ///< tests only, see WindowSettings

  planar::ReducedConvolution& convolution_for(double low, double high);
  planar::WindowSettings settings_for(const exact::BigRational& low, const exact::BigRational& high, double at) const;
  /// A window of its own for the events in [low, high]; without `covers` also of crossings inside the sum.
  std::unique_ptr<planar::Window> window_between(const exact::BigRational& low, const exact::BigRational& high,
                                                 bool covers = false);
  planar::Window* window() const { return window_.get(); }
  const planar::ExactForms& forms() const;
  std::uint64_t hash(planar::LineHashes& known) const;

 private:
  struct NextFrame {
    PlanarSum sum;
    std::vector<planar::FrameLoop*> loops;  ///< of the sum's rings, in their order; empty unless it came from loops
    bool followed = false;                  ///< the loops remember the frame before
  };
  struct KeptRings {
    std::vector<SumRing> rings;
    std::vector<std::uint8_t> outer;
    std::vector<planar::FrameLoop*> loops;  ///< of the rings
  };
  bool build_window(const planar::ScaleValue& s, double behind, double ahead);
  void drop_window();
  double widest_window(double s) const;
  Result<NextFrame> rebuilt_frame(const planar::ScaleValue& x, const planar::ScaleValue& y, FrameWork& work);
  NextFrame window_frame(const planar::ScaleValue& s, FrameWork& work);
  KeptRings kept_rings(double tau, planar::FramePlace& place, const planar::PairSource& source, PlanarSum& next);
  NextFrame assemble(double tau, planar::FramePlace& place);
  FrameChanges take(NextFrame next, bool same_place);
  std::vector<std::uint64_t> follow_rings(const NextFrame& next, bool same_place, FrameChanges& changes);

  planar::WindowController controller_;
  std::shared_ptr<planar::ReducedConvolution> convolution_;
  std::shared_ptr<const planar::ReducedConvolution> window_convolution_;  // the one the window was made from: its ids
  double fill_low_ = 0, fill_high_ = 0;  ///< scales for which the convolution's filled holes are right
  std::unique_ptr<planar::Window> window_;
  std::unique_ptr<planar::PieceLists> lists_;
  std::unique_ptr<planar::FrameLoops> loops_;
  double low_ = 0, high_ = 0;  ///< scales the window covers
  bool loops_known_ = false;
  std::vector<std::uint32_t> leaders_;  ///< vertices of the window's loops at which the last frame's rings started,
  std::vector<std::uint8_t> leads_;     ///< and whether a vertex is one of these
  std::vector<SumRing> spare_rings_;    ///< storage
  planar::RingIdentities identities_;
  mutable std::unique_ptr<planar::ExactForms> forms_;
};

namespace planar {

struct ScalingInternals {
  using State = ScalingSum::State;
};
using ScalingState = ScalingInternals::State;

}  // namespace planar
}  // namespace dymsum
