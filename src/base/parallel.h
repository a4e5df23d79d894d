// Parallel loops.
#pragma once

#include <cstddef>
#include <functional>

namespace dymsum::base {

/// Calls part(i) for every i below `parts`, on up to `threads` threads at once (0: as many as there are cores). Returns
/// when all are done; an exception of a part is thrown again here. No order is promised.
void parallel_parts(std::size_t parts, int threads, const std::function<void(std::size_t)>& part);

/// How many threads 0 stands for.
int core_count();

}  // namespace dymsum::base
