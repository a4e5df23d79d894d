// Batches: one item after the other from the list, on several threads, without the GIL.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "dymsum/progress.h"

namespace dymsum::python {

/// How many threads a number from outside stands for: 0 is as many as there are cores; no more than there are blocks.
inline int thread_count(int threads, std::size_t blocks) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads) : cores;
  return static_cast<int>(std::max<std::size_t>(1, std::min(wanted, blocks)));
}

/// item(i) for every i below `count`, in blocks, on so many threads, this one among them. The first exception is thrown
/// again here. False where progress said stop; it is asked on this thread, once before any item.
template <class Item>
bool for_each_item(std::size_t count, std::size_t block, int threads, const Progress& progress, Item&& item) {
  if (progress && !progress("items", 0)) return false;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false, refused = false;
  std::exception_ptr thrown;
  std::mutex throwing;
  const auto work = [&](bool asks) {
    try {
      for (;;) {
        const std::size_t first = next.fetch_add(block);
        if (first >= count || stop) return;
        if (asks && progress && !progress("items", static_cast<double>(first) / static_cast<double>(count))) {
          refused = stop = true;
          return;
        }
        for (std::size_t i = first; i < std::min(first + block, count); ++i) item(i);
      }
    } catch (...) {
      const std::lock_guard held(throwing);
      if (!thrown) thrown = std::current_exception();
      stop = true;
    }
  };
  std::vector<std::jthread> others;
  for (int k = 1; k < thread_count(threads, (count + block - 1) / block); ++k) others.emplace_back(work, false);
  work(true);
  others.clear();
  if (thrown) std::rethrow_exception(thrown);
  return !refused;
}

}  // namespace dymsum::python
