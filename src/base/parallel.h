// Parallel loops, a sort on several threads, and bytes that several threads write.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace dymsum::base {

/// Calls part(i) for every i below `parts`, on up to `threads` threads at once (0: as many as there are cores). Returns
/// when all are done; an exception of a part is thrown again here. No order is promised.
void parallel_parts(std::size_t parts, int threads, const std::function<void(std::size_t)>& part);

/// How many threads 0 stands for.
int core_count();

// Bytes of an array that several threads read and write, in no order: std::atomic_ref, which the standard library of
// Debian 12's emscripten lacks.

inline std::uint8_t shared_byte(const std::uint8_t& byte) { return __atomic_load_n(&byte, __ATOMIC_RELAXED); }
inline void set_shared_byte(std::uint8_t& byte, std::uint8_t value) {
  __atomic_store_n(&byte, value, __ATOMIC_RELAXED);
}

// Sorting on several threads.

/// Sorts by a strict order in which only equal values are equivalent, so that the result does not depend on threads.
/// Few values, or one thread: std::sort. Otherwise quarters are sorted and merged, which takes as much memory again.
template <class T, class Less>
void parallel_sort(std::vector<T>& values, int threads, Less less) {
  constexpr std::size_t kFew = 4096, kQuarters = 4;
  const std::size_t n = values.size();
  if (threads == 1 || n < kFew) return std::sort(values.begin(), values.end(), less);
  const auto at = [](std::vector<T>& v, std::size_t i) { return v.begin() + static_cast<std::ptrdiff_t>(i); };
  parallel_parts(kQuarters, threads, [&](std::size_t k) {
    std::sort(at(values, n * k / kQuarters), at(values, n * (k + 1) / kQuarters), less);
  });
  std::vector<T> merged(n);
  for (std::size_t pairs = kQuarters / 2; pairs > 0; pairs /= 2) {
    // Each pair of sorted runs in two parts: what comes before the midpoint of the first one, and the rest.
    parallel_parts(2 * pairs, threads, [&](std::size_t part) {
      const std::size_t k = part / 2, low = n * k / pairs, midpoint = n * (2 * k + 1) / (2 * pairs),
                        high = n * (k + 1) / pairs, half = low + (midpoint - low) / 2;
      const auto cut = std::lower_bound(at(values, midpoint), at(values, high), *at(values, half), less);
      if (part % 2 == 0) {
        std::merge(at(values, low), at(values, half), at(values, midpoint), cut, at(merged, low), less);
      } else {
        const auto before = static_cast<std::size_t>(cut - at(values, midpoint));
        std::merge(at(values, half), at(values, midpoint), cut, at(values, high), at(merged, half + before), less);
      }
    });
    values.swap(merged);
  }
}

}  // namespace dymsum::base
