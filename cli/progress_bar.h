// Progress on a terminal, and Ctrl-C.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "dymsum/progress.h"

namespace dymsum::cli {

/// While one lives, Ctrl-C ends the run at once, wherever it is: with kInterrupted, and saying so. Only while a
/// WriteGuard lives it sets a flag instead, which throw_if_interrupted() reads, and a second Ctrl-C kills. Before that,
/// while inputs are read, Ctrl-C kills at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Around the writing of a file or a report, so that neither is left half-written.
class WriteGuard {
 public:
  WriteGuard();
  ~WriteGuard();
  WriteGuard(const WriteGuard&) = delete;
  WriteGuard& operator=(const WriteGuard&) = delete;
};

/// What an interrupted run prints on standard output: a report of the failure.
void print_when_interrupted(std::string text);

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
