// What every rival says about a sum, in numbers that can be compared with ours, and how everyone is timed.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace dymsum::bench {

/// Repeat at least `least` times unless `enough_ms` are used before, and on until `most` times or `budget_ms`; once at
/// least.
struct Repeats {
  int least = 1;
  int most = 1;
  double budget_ms = 0;
  double enough_ms = 0;
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

/// Processor time of this process, all threads together: unlike the wall clock it does not charge a long run for what
/// else the machine does, and it gives nothing away to a rival that uses one thread.
inline double cpu_ms() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// What reading the clock takes at least. A small sum takes little longer, so it is taken off every time, ours and the
/// rivals'.
inline double clock_ms() {
  static const double least = [] {
    double best = 1;
    for (int k = 0; k < 2000; ++k) {
      const double start = cpu_ms();
      best = std::min(best, cpu_ms() - start);
    }
    return best;
  }();
  return least;
}

/// Times `work()`, whose result is destroyed outside the timed part; the last result is handed to `keep`.
template <class Work, class Keep>
Times measure(const Repeats& repeats, Work&& work, Keep&& keep) {
  Times times;
  const double clock = clock_ms();
  double used = 0;
  const auto again = [&] {
    const int runs = static_cast<int>(times.ms.size());
    return runs == 0 || (runs < repeats.least && used < repeats.enough_ms) ||
           (runs < repeats.most && used < repeats.budget_ms);
  };
  while (again()) {
    const double start = cpu_ms();
    auto result = work();
    const double stop = cpu_ms();
    times.ms.push_back(std::max(stop - start - clock, 0.0));
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
