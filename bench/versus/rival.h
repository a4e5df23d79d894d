// What every rival says about a sum, in numbers that can be compared with ours, and how everyone is timed.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace dymsum::bench {

/// Repeat at least `least` times, and on until `most` times or until `budget_ms` are used.
struct Repeats {
  int least = 1;
  int most = 1;
  double budget_ms = 0;
};

struct Times {
  std::vector<double> ms;  ///< one per repetition, in order

  double median() const {
    if (ms.empty()) return 0;
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  }
  double min() const { return ms.empty() ? 0 : *std::min_element(ms.begin(), ms.end()); }
};

/// Times `work()`, whose result is destroyed outside the timed part; the last result is handed to `keep`.
template <class Work, class Keep>
Times measure(const Repeats& repeats, Work&& work, Keep&& keep) {
  Times times;
  double used = 0;
  while (static_cast<int>(times.ms.size()) < repeats.least ||
         (static_cast<int>(times.ms.size()) < repeats.most && used < repeats.budget_ms)) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    const auto stop = std::chrono::steady_clock::now();
    times.ms.push_back(std::chrono::duration<double, std::milli>(stop - start).count());
    used += times.ms.back();
    keep(std::move(result));
  }
  return times;
}

/// One answer. `vertices` are counted after merging collinear ones.
struct RivalAnswer {
  bool finished = false;
  std::string why_not;  ///< "stopped after 20 s", "crashed (signal 11)", "cannot take holes"
  double median_ms = 0, min_ms = 0;
  int runs = 0;
  double area = 0;
  std::string area_exact;  ///< "num/den", empty where the rival is inexact or the sum too large to add up exactly
  std::size_t outer = 0, holes = 0, vertices = 0;
};

}  // namespace dymsum::bench
