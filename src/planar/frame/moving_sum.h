// The one skeleton of planar sums in motion. A move goes to the window that covers the new position - the one the last
// frame was made in, one that was left, one made ahead - or builds one where the controller expects that to pay; the
// window updates its loops, or the static engine computes the frame; then rings get their identities, and changes and
// costs are reported.
//
// A motion (scaling, rotating) supplies windows, the frame inside one and what both cost.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "dymsum/frames.h"
#include "planar/frame/frame_rings.h"
#include "planar/operand/operand.h"
#include "planar/window/frame_window.h"

namespace dymsum::planar {

// Chooses how wide the next window is, or that a frame is better computed from scratch, by what frames have cost so
// far.

/// What a motion counts is in about microseconds. Unlike time it is the same in every run and whatever else the machine
/// does, so that every run makes the same choices.
inline double cost_of(double each, std::uint64_t n) { return each * static_cast<double>(n); }

/// Steps and widths are natural logarithms of scales, or angles.
class WindowController {
 public:
  WindowController() = default;
  /// The first window, whose cost nobody knows, covers at most so many steps ahead, and at most `first_width`; the next
  /// ones `factor` times as many or fewer. What windows cost more than frames from scratch, these have to make up for
  /// by `payback` times as many before another one is tried.
  WindowController(double first_frames, double first_width, double factor, double payback)
      : frames_ahead_(first_frames), first_width_(first_width), factor_(factor), payback_(payback) {}

  struct Choice {
    bool window = false;
    double behind = 0, ahead = 0;  ///< how far the window reaches below and above the scale
  };
  /// Chooses how a frame outside the current window is made, `step` after the last one; windows should not be wider
  /// than `widest`, unless that is less than a few steps. `window`: their width where the caller knows it, else 0.
  Choice choose(double step, double widest, FrameMode mode, double window);

  /// What was counted, in any unit: a frame from scratch; a frame that built a window; a frame inside one.
  void rebuilt(double cost);
  void built(double cost);
  /// What building a window may cost before it is abandoned, or 0 if that is not known; and that it was, for a frame
  /// `step` after the last.
  double most_expensive_building() const;
  void abandoned(double step);
  /// Whether frames inside the window have been more expensive than from scratch three times in a row.
  bool give_up(double cost);
  /// Frames go on in a window that was built before, or elsewhere: what they cost says nothing of how wide windows
  /// should be, nor whether they pay.
  void returned();
  /// How wide the next window should be, `step` after step.
  double width(double step, double widest) const;
  void updated(double cost);

 private:
  void close_window();
  void rest(double step, double lost = 0);

  double static_cost_ = 0;
  double frames_ahead_ = 6;  ///< how many steps a window covers ahead
  double first_width_ = 0.4;
  double factor_ = 1.5;   ///< what that was last multiplied by
  double last_cost_ = 0;  ///< a frame of the last window, with its fraction of the building
  double spent_ = 0;
  bool counts_ = false;       ///< frames are of the window that was built last
  std::uint64_t served_ = 0;  ///< frames of the open window
  double recent_ = 0;         ///< the largest recent step, fading
  double last_step_ = 0;      ///< the last one outside of windows
  double payback_ = 0;
  int expensive_ = 0;
  std::uint64_t windows_since_ = 0;
  double bad_step_ = 0;                   ///< windows did not pay at this step
  std::uint64_t rest_ = 0, backoff_ = 8;  ///< frames until they are tried again
};

class MovingSum {
 public:
  explicit MovingSum(MovingOptions options);
  virtual ~MovingSum() = default;

  /// The first frame is computed from scratch.
  template <class MoveTo>
  Result<FrameChanges> begin(const MoveTo& move_to) {
    const FrameMode mode = std::exchange(options.mode, FrameMode::rebuild);
    Result<FrameChanges> changes = move_to();
    options.mode = mode;
    return changes;
  }

  MovingOptions options;
  PlanarSum sum;
  std::vector<std::uint64_t> ring_ids;
  FrameWork work;

  /// Tests query what is kept, and wait until the window that is being made is ready.
  const KeptWindows& kept_windows() const { return kept_; }
  void finish_window_ahead();
  /// The budget of MovingOptions::memory; null where there is no limit.
  const std::shared_ptr<base::MemoryBudget>& budget() const { return budget_; }

 protected:
  /// A move, as the controller sees it: lengths are logarithms of scales, or angles. A motion adds the new position as
  /// it has it, and gets its own move back wherever it is called during one.
  struct Move {
    bool windows = true;       ///< whether windows can serve at the new position
    bool builds = true;        ///< whether one may be built for it
    bool stays = false;        ///< it is the old position
    std::uint64_t family = 0;  ///< of positions: windows serve those of their own only
    double at = 0;             ///< the new position, as windows have it
    double step = 0;           ///< from the old position to the new one
    double widest = 0;         ///< windows should not be wider
    double requested = 0;      ///< the width that the options request, or 0
  };
  struct NextFrame {
    PlanarSum sum;
    bool followed = false;  ///< the loops know the identities, and the changes are listed
    std::vector<std::uint64_t*>
        identities;  ///< where the loops keep them, for the sum's rings in order; empty: no loops
    FrameChanges changes;
  };

  /// Changes nothing on an error. The motion takes its new position over when this succeeds.
  Result<FrameChanges> move(const Move& move);
  /// The rings of kept loops as those of the frame's sum, in canonical order; puts the loops into this order.
  static void position(KeptRings& kept, NextFrame& next);
  /// Storage of a ring that is gone, for one of a frame that comes; what it holds means nothing.
  SumRing spare_ring();
  bool chooses() const { return options.mode == FrameMode::automatic && options.window == 0; }
  /// Windows are made on a thread of their own.
  bool makes_ahead() const { return options.threads > 1 && chooses(); }
  /// The current window, or nothing.
  FrameWindow* window() const { return window_.get(); }

  WindowController controller_;
  RingIdentities identities_;

 private:
  /// The operands at the new position.
  virtual PlacedPair placed(const Move& move) const = 0;
  /// What makes a window for the new position that reaches so far.
  virtual MakeWindow window_for(const Move& move, const WindowController::Choice& reach) = 0;
  /// The same for one that is entered at `end` by a motion such as the last move, and so wide.
  virtual MakeWindow window_from(double end, const Move& move, double width) = 0;
  /// The current window is about to be `next`, or none.
  virtual void window_changes(FrameWindow* next) = 0;
  /// The frame at the new position inside the window; nothing where it has to be computed from scratch.
  virtual std::optional<NextFrame> window_frame(const Move& move, FrameWork& work) = 0;
  /// The costs of the frame that has just been taken over, and of the window that was built for it.
  virtual double cost_of(const FrameWork& work) = 0;
  virtual double cost_of_window() const = 0;

  Result<FrameChanges> frame_at(const Move& move);
  Result<bool> open_window(const Move& move, FrameWork& work);
  bool enter_window(const Move& move);
  void set_window(std::unique_ptr<FrameWindow> next, bool keep);
  void take_window_ahead();
  void start_ahead(MakeWindow make, double step);
  void make_next_window(const Move& move);
  Result<NextFrame> rebuilt_frame(const Move& move, FrameWork& work) const;
  FrameChanges take(NextFrame next, const Move& move);
  void charge(const FrameWork& work);

  std::vector<SumRing> spare_rings_;
  const std::shared_ptr<base::MemoryBudget> budget_;
  std::unique_ptr<FrameWindow> window_;
  KeptWindows kept_;
  std::unique_ptr<FrameWindow> made_ahead_;
  bool too_expensive_ahead_ = false;  ///< the next window was abandoned, and none has been entered since
  double step_ahead_ = 0;             ///< that the window under way was started at
  WindowAhead ahead_;
};

}  // namespace dymsum::planar
