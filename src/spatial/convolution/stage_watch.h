// What the stages of a solid sum share: threads, progress, and a budget of memory.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string_view>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// Thrown where a stage is about to hold more than the budget.
struct OverBudget {
  std::uint64_t bytes;  ///< that it would hold
};

class StageWatch {
 public:
  StageWatch(const SpatialOptions& options, SpatialStats& stats) : options_(options), stats_(stats) {}

  /// Ends the stage before it and begins one; an empty name only ends.
  void begin(std::string_view name) {
    const double ms = watch_.lap();
    if (!stats_.stages.empty() && begun_) stats_.stages.back().ms = ms;
    begun_ = !name.empty();
    if (name.empty()) return;
    stats_.stages.push_back({name, 0});
    query(0);
  }

  /// Calls part(k) for all k below `parts`, on several threads, and in between asks progress, on the caller's thread
  /// alone, whether to go on. A few parts take less than waking other threads.
  template <class F>
  void run(std::size_t parts, F part) {
    constexpr std::size_t kFewParts = 3;
    std::atomic<std::size_t> done{0};
    base::parallel_parts(parts, parts <= kFewParts ? 1 : options_.threads, [&](std::size_t k) {
      if (stop_.load(std::memory_order_relaxed)) throw Cancelled{};
      part(k);
      const std::size_t so_far = done.fetch_add(1, std::memory_order_relaxed) + 1;
      if (std::this_thread::get_id() == caller_) query(static_cast<double>(so_far) / static_cast<double>(parts));
    });
  }
  /// Calls part(k, first, last) for the k-th interval of `size` of `count` things, as run() does.
  template <class F>
  void run_intervals(std::size_t count, std::size_t size, F part) {
    run((count + size - 1) / size, [&](std::size_t k) { part(k, k * size, std::min(count, (k + 1) * size)); });
  }
  /// Sorts by an order in which only equal values are equivalent.
  template <class T, class Less>
  void sort(std::vector<T>& values, Less less) const {
    base::parallel_sort(values, options_.threads, less);
  }
  int threads() const { return options_.threads; }
  /// To be called in parts that take long, now and then: as ask() on the caller's thread, and stops on the others, too.
  void query_within_part(double fraction) {
    if (stop_.load(std::memory_order_relaxed)) throw Cancelled{};
    if (std::this_thread::get_id() == caller_) query(fraction);
  }

  /// Stages that run in one piece call this now and then.
  void query(double fraction) {
    if (options_.progress && !options_.progress(stats_.stages.back().name, fraction)) {
      stop_ = true;
      throw Cancelled{};
    }
  }

  /// Accounts for memory from here to the end of the sum.
  void hold(std::uint64_t bytes) {
    const std::uint64_t all = held_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    if (options_.memory != 0 && all > options_.memory) throw OverBudget{all};
  }
  std::uint64_t held() const { return held_; }

 private:
  const SpatialOptions& options_;
  SpatialStats& stats_;
  Stopwatch watch_;
  const std::thread::id caller_ = std::this_thread::get_id();
  bool begun_ = false;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> held_{0};
};

}  // namespace dymsum::spatial
