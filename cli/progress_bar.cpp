#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <iostream>
#include <string>
#include <utility>

#include "exit_code.h"

namespace dymsum::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0, writing = 0, bar_shown = 0;
std::string last_words;  // on standard output; not changed once signals are caught

// The stage that is being worked on: there is one bar at a time.
struct Stage {
  std::string name;
  double fraction = 0;
  std::chrono::steady_clock::time_point start;
};
Stage current;

// What is left of a stage, from the time it has taken so far: nothing while that tells little.
std::string time_left(double seconds, double fraction) {
  if (seconds < 1 || fraction <= 0 || fraction >= 1) return "";
  const double left = seconds / fraction * (1 - fraction);
  return left < 100 ? ", " + std::to_string(static_cast<int>(std::ceil(left))) + " s left"
                    : ", " + std::to_string(static_cast<int>(std::ceil(std::min(left / 60, 1e6)))) + " min left";
}

// Where other programs have the processor, what takes long need not be much.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The progress of the current stage, with its name.
std::string how_far(std::chrono::steady_clock::time_point now) {
  const double fraction = std::clamp(current.fraction, 0.0, 1.0);
  return std::to_string(static_cast<int>(fraction * 100)) + "% " + current.name +
         time_left(std::chrono::duration<double>(now - current.start).count(), fraction);
}

void say(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// Calls only what a signal handler may call. No file is open for writing here: there is nothing to put in order.
extern "C" void on_interrupt(int) {
  if (writing != 0) {
    interrupted = 1;
    std::signal(SIGINT, SIG_DFL);
    return;
  }
  say(STDOUT_FILENO, last_words);
  if (bar_shown != 0) say(STDERR_FILENO, "\r\x1b[K");
  say(STDERR_FILENO, "dymsum: interrupted\n");
  ::_exit(kInterrupted);
}

}  // namespace

void print_when_interrupted(std::string text) { last_words = std::move(text); }

InterruptGuard::InterruptGuard() : before_(std::signal(SIGINT, on_interrupt)) {}
InterruptGuard::~InterruptGuard() {
  if (interrupted == 0) std::signal(SIGINT, before_);
}

WriteGuard::WriteGuard() { writing = writing + 1; }
WriteGuard::~WriteGuard() { writing = writing - 1; }

void throw_if_interrupted() {
  if (interrupted != 0) throw Stop(kInterrupted, "interrupted");
}

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + std::chrono::seconds(terminal_ ? 1 : 2)) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::cerr << "\r\x1b[K" << std::flush;
  bar_shown = 0;
}

Progress ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    const Clock::time_point now = Clock::now();
    if (stage != current.name || fraction < current.fraction) {  // the next stage, or the same one once more
      current.name = stage;
      current.start = now;
    }
    current.fraction = fraction;
    if (now >= next_) {
      if (terminal_) draw(now);
      else if (processor_seconds() >= 1) print_line(now);
    }
    return interrupted == 0;
  };
}

void ProgressBar::draw(Clock::time_point now) {
  next_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  bar_shown = 1;
  constexpr int kWidth = 40;
  const double fraction = std::clamp(current.fraction, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(fraction * kWidth);
  std::cerr << "\r[" << std::string(full, '#') << std::string(kWidth - full, '.') << "] " << how_far(now) << "\x1b[K"
            << std::flush;
}

void ProgressBar::print_line(Clock::time_point now) {
  next_ = now + (now - start_);
  std::cerr << "dymsum: at work for " << std::chrono::duration_cast<std::chrono::seconds>(now - start_).count()
            << " s, " << how_far(now) << "\n"
            << std::flush;
}

}  // namespace dymsum::cli
