// The same question about many points, with progress.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"

namespace dymsum::planar {

/// Returns inside(k) for every k below `count`, block after block on so many threads (1: true); progress is queried on
/// this one before each block. Errors: cancelled.
template <class Inside>
Result<std::vector<std::uint8_t>> answer_blocks(std::size_t count, std::size_t block, std::size_t fraction, int threads,
                                                const Progress& progress, Inside&& inside) {
  std::vector<std::uint8_t> answers(count);
  for (std::size_t first = 0; first < count; first += block) {
    if (progress && !progress("points", static_cast<double>(first) / static_cast<double>(count))) return cancelled();
    const std::size_t last = std::min(count, first + block);
    base::parallel_parts((last - first + fraction - 1) / fraction, threads, [&](std::size_t part) {
      const std::size_t begin = first + part * fraction;
      for (std::size_t k = begin; k < std::min(last, begin + fraction); ++k) answers[k] = inside(k) ? 1 : 0;
    });
  }
  return answers;
}

}  // namespace dymsum::planar
