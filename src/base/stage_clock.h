// How long the stages of a computation take.
#pragma once

#include <optional>
#include <string_view>

#include "base/stopwatch.h"

namespace dymsum {

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
