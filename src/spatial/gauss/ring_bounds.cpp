#include "spatial/gauss/ring_bounds.h"

#include <algorithm>

namespace dymsum::spatial {

RingBounds::RingBounds(std::span<const Vec3> vectors) {
  const auto n = static_cast<std::uint32_t>(vectors.size());
  std::uint32_t width = 8;
  for (std::uint32_t level = 0;; ++level, width *= 8) {
    top_ = level;
    for (std::uint32_t first = 0; first < n; first += width) {
      const std::uint32_t last = std::min(n, first + width);
      Vec3 sum{0, 0, 0};
      for (std::uint32_t k = first; k < last; ++k) sum = sum + vectors[k];
      Ball ball{(1.0 / (last - first)) * sum, 0, first, last};
      for (std::uint32_t k = first; k < last; ++k)
        ball.radius = std::max(ball.radius, length(vectors[k] - ball.centre));
      ball.radius = ball.radius * kOutwards + 0x1p-40;
      balls_.push_back(ball);
    }
    starts_[level + 1] = static_cast<std::uint32_t>(balls_.size());
    if (balls_of(level) <= 8) return;
  }
}

}  // namespace dymsum::spatial
