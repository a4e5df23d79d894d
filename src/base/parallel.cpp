#include "base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <algorithm>

#include "base/memory_budget.h"

namespace dymsum::base {

void parallel_parts(std::size_t parts, int threads, const std::function<void(std::size_t)>& part) {
  if (parts <= 1 || threads == 1) {
    for (std::size_t i = 0; i < parts; ++i) part(i);
    return;
  }
  // More threads than cores make TBB warn, and serve nobody.
  tbb::task_arena arena(threads <= 0 ? tbb::task_arena::automatic : std::min(threads, core_count()));
  const std::shared_ptr<MemoryBudget> budget = current_budget();
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) {
      const UseBudget use(budget);
      part(i);
    });
  });
}

int core_count() { return std::max(1, tbb::this_task_arena::max_concurrency()); }

}  // namespace dymsum::base
