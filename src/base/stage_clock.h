// How long the stages of a computation take.
#pragma once

#include <chrono>
#include <string_view>

namespace dymsum {

/// Appends the time since the last stage to stats.stages, in milliseconds. One that does not run costs nothing: reading
/// the clock takes as long as a stage of a small computation.
template <class Stats>
class StageClock {
 public:
  StageClock(Stats& stats, bool runs) : stats_(stats), runs_(runs) {
    if (runs) last_ = Clock::now();
  }
  void done(std::string_view stage) {
    if (!runs_) return;
    const auto now = Clock::now();
    stats_.stages.push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Stats& stats_;
  bool runs_;
  Clock::time_point last_;
};

}  // namespace dymsum
