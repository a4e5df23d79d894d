// A window that is made on a thread of its own while frames go on. What it becomes does not depend on when it is ready.
#pragma once

#include <memory>

#include "base/around_forks.h"
#include "planar/window/frame_window.h"

namespace dymsum::planar {

/// Used by one thread, except for the work itself. The thread that does it is started with the first window, and waits
/// for the next one: waking it costs a frame less than starting one. Destroying this stops the work and waits until it
/// has stopped. Around a fork the work rests: what was done for the window is lost, and the parent begins it again. A
/// child has no thread, so no window is under way there until one is started.
class WindowAhead final : private base::AroundForks {
 public:
  WindowAhead();
  ~WindowAhead();
  WindowAhead(const WindowAhead&) = delete;
  WindowAhead& operator=(const WindowAhead&) = delete;

  /// Requires: not busy.
  void start(MakeWindow make);
  /// A window is under way, or waits to be taken.
  bool busy() const { return busy_; }
  bool ready() const;
  /// Takes the window, or nothing where it would have cost too much; waits until it is ready. Requires: busy.
  std::unique_ptr<FrameWindow> take();

 private:
  void before_fork() override;
  void after_fork_in_parent() override;
  void after_fork_in_child() override;

  struct Worker;
  /// Starts the thread. False where memory or threads have run out.
  bool begin();

  bool busy_ = false;
  std::unique_ptr<Worker> worker_;  // nothing: no window comes of what was started
};

}  // namespace dymsum::planar
