// How planning queries whether to go on: seldom enough that small tables are planned whatever the limit of time.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/poll.h"
#include "dymsum/progress.h"

namespace dymsum::nesting {

class PlanningPoll {
 public:
  explicit PlanningPoll(const Progress& progress) : progress_(progress) {}

  /// Throws Cancelled where the callback says to stop.
  void now(std::string_view stage, std::size_t round, std::size_t rounds) const {
    if (progress_ && !progress_(stage, static_cast<double>(round) / static_cast<double>(rounds))) throw Cancelled{};
  }
  /// Polls once in 4096 rounds of a loop.
  void at(std::string_view stage, std::size_t round, std::size_t rounds) const {
    if (round % 4096 == 4095) now(stage, round, rounds);
  }

 private:
  const Progress& progress_;
};

}  // namespace dymsum::nesting
