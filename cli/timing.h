// Running a computation several times in process and reporting how long it took.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace dymsum::cli {

struct Timing {
  double median_ms = 0, min_ms = 0;
  std::size_t repeats = 1;
};

inline Timing timing_of(std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  const std::size_t n = ms.size();
  return {(ms[(n - 1) / 2] + ms[n / 2]) / 2, ms.front(), n};
}

/// Calls `compute` `repeats` >= 1 times; the last value and the times.
template <class Compute>
auto timed(std::size_t repeats, Compute&& compute) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> ms;
  const auto once = [&] {
    const auto start = Clock::now();
    auto value = compute();
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    return value;
  };
  for (std::size_t i = 1; i < repeats; ++i) static_cast<void>(once());
  auto value = once();
  return std::pair{std::move(value), timing_of(std::move(ms))};
}

}  // namespace dymsum::cli
