// Chooses how wide the next window is, or that a frame is better computed from scratch, by what frames have cost so
// far.
#pragma once

#include <cstdint>

#include "dymsum/frames.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
