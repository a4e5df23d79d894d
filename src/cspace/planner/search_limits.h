// How long a search goes on.
#pragma once

#include <chrono>
#include <cstdint>

#include "dymsum/progress.h"

namespace dymsum::planar {

enum class SearchStop : std::uint8_t { none, cancelled, out_of_time };

struct SearchLimits {
  std::chrono::steady_clock::time_point deadline;
  Progress progress;

  /// The search queries it between two steps.
  SearchStop query() const {
    if (progress && !progress("search", 0)) return SearchStop::cancelled;
    return std::chrono::steady_clock::now() > deadline ? SearchStop::out_of_time : SearchStop::none;
  }
};

}  // namespace dymsum::planar
