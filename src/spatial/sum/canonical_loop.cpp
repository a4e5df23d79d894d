#include "spatial/sum/canonical_loop.h"

#include <algorithm>

namespace dymsum::spatial {

void start_at_smallest(std::vector<std::uint32_t>& loop) {
  const std::size_t n = loop.size();
  std::size_t best = 0;
  for (std::size_t at = 1; at < n; ++at) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t x = loop[(at + k) % n], y = loop[(best + k) % n];
      if (x == y) continue;
      if (x < y) best = at;
      break;
    }
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best), loop.end());
}

}  // namespace dymsum::spatial
