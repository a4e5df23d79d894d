// The one skeleton of planar sums in motion. A move goes to the window that covers the new position, or builds one
// where the controller expects that to pay; the window updates its loops, or the static engine computes the frame; then
// rings get their identities, and changes and costs are told.
//
// A motion (scaling, rotating) supplies the window, the frame inside it and what both cost.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/frames.h"
#include "planar/frames/controller.h"
#include "planar/frames/frame_rings.h"
#include "planar/operand/placed_pair.h"

namespace dymsum::planar {

class MovingSum {
 public:
  explicit MovingSum(MovingOptions options) : options(std::move(options)) {}
  virtual ~MovingSum() = default;

  MovingOptions options;
  PlanarSum sum;
  std::vector<std::uint64_t> ring_ids;
  FrameWork work;

 protected:
  /// A move, as the controller sees it: lengths are logarithms of scales, or angles.
  struct Move {
    bool windows = true;  ///< whether windows can serve at the new position
    bool inside = false;  ///< it lies in the current window
    bool stays = false;   ///< it is the old position
    double step = 0;      ///< from the old position to the new one
    double widest = 0;    ///< windows should not be wider
    double asked = 0;     ///< the width that the options ask for, or 0
  };
  struct NextFrame {
    PlanarSum sum;
    bool followed = false;  ///< the loops know the identities, and the changes are listed
    std::vector<std::uint64_t*>
        identities;  ///< where the loops keep them, for the sum's rings in order; empty: no loops
    FrameChanges changes;
  };
  struct WindowCost {
    double counted = 0, forgiven = 0;  ///< see WindowController::built
  };

  /// Changes nothing on an error. The motion takes its new position over when this succeeds.
  Result<FrameChanges> move(const Move& move);
  /// Storage of a ring that is gone, for one of a frame that comes; what it holds means nothing.
  SumRing spare_ring();
  bool chooses() const { return options.mode == FrameMode::automatic && options.window == 0; }

  WindowController controller_;
  RingIdentities identities_;

 private:
  /// The operands at the new position.
  virtual PlacedPair placed() const = 0;
  /// A window for the new position is under way elsewhere: the frame is computed from scratch.
  virtual bool awaits_window(const Move&) const { return false; }
  /// Whether a window that reaches so far is made elsewhere; until then frames are computed from scratch.
  virtual bool build_elsewhere(const Move&, const WindowController::Choice&) { return false; }
  /// Makes the current window one that covers the new position. False: it would cost too much, and there is none.
  virtual bool build_window(const Move& move, const WindowController::Choice& reach) = 0;
  virtual void drop_window() = 0;
  /// The same where frames inside it were more expensive than from scratch.
  virtual void abandon_window() { drop_window(); }
  virtual bool has_window() const = 0;
  /// The frame at the new position inside the window; nothing where it has to be computed from scratch.
  virtual std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) = 0;
  /// Of the frame that has just been taken over; of the window that was built for it.
  virtual double cost_of(const FrameWork& work) = 0;
  virtual WindowCost cost_of_window() const = 0;

  Result<bool> open_window(const Move& move, FrameWork& work);
  Result<NextFrame> rebuilt_frame(FrameWork& work) const;
  FrameChanges take(NextFrame next, const Move& move);
  void charge(const FrameWork& work);

  std::vector<SumRing> spare_rings_;
};

}  // namespace dymsum::planar
