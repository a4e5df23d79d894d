// A window that is made on a thread of its own while frames go on. What it becomes does not depend on when it is ready.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include "planar/scaling/window_builder.h"
#include "planar/scaling/window_frames.h"

namespace dymsum::planar {

/// Used by one thread, except for the work itself. Destroying it stops the work and waits until it has stopped.
class WindowAhead {
 public:
  /// Requires: nothing is under way. `entry`: the scale inside it at which lists and loops are made.
  void start(WindowPlan plan, std::shared_ptr<const OperandPair> base, const exact::BigRational& entry);
  /// A window is under way, or waits to be taken.
  bool busy() const { return thread_.joinable(); }
  bool ready() const { return busy() && ready_.load(std::memory_order_acquire); }
  /// Takes the window, or nothing where it would have cost too much; waits until it is ready. Requires: busy.
  std::unique_ptr<WindowFrames> take();

 private:
  std::unique_ptr<WindowFrames> frames_;  // written by the thread until it is ready
  std::atomic<bool> ready_ = false;
  std::jthread thread_;  // stopped and joined before what it writes to dies
};

}  // namespace dymsum::planar
