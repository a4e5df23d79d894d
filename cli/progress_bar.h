// Progress on standard error, and Ctrl-C.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "dymsum/progress.h"

namespace dymsum::cli {

/// While one lives, Ctrl-C ends the run at once, wherever it is: with kInterrupted, and saying so. Only while a
/// WriteGuard lives it sets a flag instead, which throw_if_interrupted() reads, and a second Ctrl-C kills. Before that,
/// while inputs are read, Ctrl-C kills at once. Guards may lie in one another.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*before_)(int);
};

/// Guards the writing of a file or a report, so that neither is left half-written.
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

/// Tells on standard error how far a computation is: on a terminal by a bar, after a second of work and gone when the
/// work is; elsewhere by a line after two seconds, one of them computed, and whenever the time so far has doubled.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// What is handed to a computation; it must not outlive the bar. False after Ctrl-C.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(Clock::time_point now);
  void print_line(Clock::time_point now);

  bool terminal_ = false;
  Clock::time_point start_, next_;  ///< `next_`: when something is told again
  bool drawn_ = false;
};

}  // namespace dymsum::cli
