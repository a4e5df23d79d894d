// The state behind a RotatingSum: one window, its loops, and the current frame.
#pragma once

#include <memory>

#include "dymsum/rotating_sum.h"
#include "planar/frames/controller.h"
#include "planar/frames/frame_rings.h"
#include "planar/rotating/rotating_loops.h"

namespace dymsum {

class RotatingSum::State {
 public:
  /// Errors: unsupported_operand.
  static Result<std::unique_ptr<State>> create(const Region& p, const Region& q, const RotatingOptions& options);

  /// Changes nothing on an error.
  Result<FrameChanges> move_to(const Orientation& theta);

  RotatingOptions options;
  Orientation orientation;
  PlanarSum sum;
  std::vector<std::uint64_t> ring_ids;
  FrameWork work;

 private:
  struct NextFrame {
    PlanarSum sum;
    std::vector<std::uint64_t> ids;
    bool followed = false;  ///< the identities come from the frame before
    bool updated = false;
    FrameChanges changes;
  };
  /// The turn of the moving operand in the frame in which the other one rests.
  double moving_angle(const Orientation& theta) const { return (swapped_ == p_turns() ? 1 : -1) * theta.radians(); }
  bool p_turns() const { return options.turning == TurningOperand::p; }
  double widest_window() const;
  void build_window(double low, double high);
  void drop_window();
  Result<NextFrame> rebuilt_frame(const Orientation& theta, FrameWork& work);
  /// Nothing where doubles do not decide the frame.
  std::optional<NextFrame> window_frame(const Orientation& theta, FrameWork& work);
  /// From the coordinates of the forms to those of the sum: scaled, perhaps turned, and moved.
  struct Rigid {
    double xx = 1, xy = 0, yx = 0, yy = 1;
    Point by;
  };
  Rigid to_sum(const Orientation& theta) const;
  bool assemble(const Orientation& theta, NextFrame& next);
  /// How the sum names a segment and its end.
  struct Names {
    Contact contact;
    std::uint32_t corner_p = 0, corner_q = 0;
  };
  const Names& names(std::uint32_t segment);
  bool place_ring(const planar::RotatingLoops::Loop& loop, const Rigid& rigid, double& error);
  SumRing ring(const planar::RotatingLoops::Loop& loop);

  std::shared_ptr<const planar::OperandPair> base_;        // P is operand 0
  std::shared_ptr<const planar::OperandPair> forms_base_;  // the moving operand is operand 1: the smaller one
  bool swapped_ = false;                                   // that is P
  std::unique_ptr<planar::TurningForms> forms_;
  std::unique_ptr<planar::TurnCatalog> catalog_;
  std::unique_ptr<planar::TurnGrid> grid_;
  double segments_ = 0;  // of the reduced convolution, about
  planar::WindowController controller_;
  double slice_cost_ = 0;  // of the last frame from scratch
  planar::RingIdentities identities_;
  std::unique_ptr<planar::RotatingWindow> window_;
  std::unique_ptr<planar::RotatingFrame> frame_;
  std::unique_ptr<planar::RotatingLoops> loops_;
  std::vector<Names> names_;          // of the window's segments, made when first asked for
  std::vector<std::uint32_t> steps_;  // scratch: the steps of a ring that end at its vertices
  std::vector<Point> places_;         // and where
};

namespace planar {

struct RotatingInternals {
  using State = RotatingSum::State;
};
using RotatingState = RotatingInternals::State;

}  // namespace planar
}  // namespace dymsum
