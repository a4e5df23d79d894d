// The stand-in for parallel.cpp where there are no threads.
#include "base/parallel.h"

namespace dymsum::base {

void parallel_parts(std::size_t parts, int, const std::function<void(std::size_t)>& part) {
  for (std::size_t i = 0; i < parts; ++i) part(i);
}

int core_count() { return 1; }

}  // namespace dymsum::base
