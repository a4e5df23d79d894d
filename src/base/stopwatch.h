// How much time has passed, and how long the stages of a computation take.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace dymsum {

class Stopwatch {
 public:
  /// The milliseconds since it was made or the last lap().
  double ms() const { return in_ms(Clock::now() - begin_); }
  /// The same, and begins anew.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double ms = in_ms(now - begin_);
    begin_ = now;
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double in_ms(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }
  Clock::time_point begin_ = Clock::now();
};

/// Appends the time since the last stage to stats.stages, in milliseconds. One that does not run costs nothing: reading
/// the clock takes as long as a stage of a small computation.
template <class Stats>
class StageClock {
 public:
  StageClock(Stats& stats, bool runs) : stats_(stats) {
    if (runs) watch_.emplace();
  }
  void done(std::string_view stage) {
    if (watch_) stats_.stages.push_back({stage, watch_->lap()});
  }

 private:
  Stats& stats_;
  std::optional<Stopwatch> watch_;
};

}  // namespace dymsum
