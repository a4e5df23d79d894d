// A window that is made on a thread of its own while frames go on. What it becomes does not depend on when it is ready.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "planar/frames/frame_window.h"

namespace dymsum::planar {

/// Used by one thread, except for the work itself. The thread that does it is started with the first window, and waits
/// for the next one: waking it costs a frame less than starting one. Destroying this stops the work and waits until it
/// has stopped.
class WindowAhead {
 public:
  /// Requires: not busy.
  void start(MakeWindow make);
  /// A window is under way, or waits to be taken.
  bool busy() const { return busy_; }
  bool ready() const { return busy_ && ready_.load(std::memory_order_acquire); }
  /// Takes the window, or nothing where it would have cost too much; waits until it is ready. Requires: busy.
  std::unique_ptr<FrameWindow> take();

 private:
  void work(const std::stop_token& stop);

  bool busy_ = false;
  std::atomic<bool> ready_ = false;  // written under the mutex
  std::mutex mutex_;
  std::condition_variable_any wake_;     // to the thread: there is something to make, and back: it is made
  MakeWindow make_;                      // what the thread has not taken yet
  std::unique_ptr<FrameWindow> window_;  // written by the thread until it is ready
  std::jthread thread_;                  // stopped and joined before what it writes to dies
};

}  // namespace dymsum::planar
