// Progress on a terminal, and Ctrl-C.
#pragma once

#include <chrono>
#include <string_view>

#include "dymsum/progress.h"

namespace dymsum::cli {

/// While one lives, Ctrl-C only sets a flag, which the progress callback and throw_if_interrupted() read, so that no
/// file is left half-written; a second Ctrl-C kills. Before that, while inputs are read, Ctrl-C kills at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

void throw_if_interrupted();  ///< Stop with kInterrupted

/// A bar on standard error, only where that is a terminal and only after a second of work; gone when the work is.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// To hand to a computation; must not outlive the bar. False after Ctrl-C.
  Progress callback();

 private:
  void draw(std::string_view stage, double fraction);

  using Clock = std::chrono::steady_clock;
  Clock::time_point next_draw_;
  bool terminal_ = false;
  bool drawn_ = false;
};

}  // namespace dymsum::cli
