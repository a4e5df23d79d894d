#include "planar/turning/box_pairs.h"

#include <cstring>
#include <limits>

namespace dymsum::planar {
// Where the extent is minute or huge the factor is not a number of use: then all boxes meet.
BoxPairs::BoxPairs(double extent) {
  const double factor = (kBoxQuanta - 1) / extent;
  per_unit_ = factor <= std::numeric_limits<double>::max() ? factor : 0;
}

// Behind the last box lie some that start to the right of everything and meet nothing. Which of eight boxes meet cannot
// be predicted: all are listed and the place moves on for those that do.
std::vector<std::array<std::uint32_t, 2>> BoxPairs::find() {
  const std::size_t n = boxes_.size();
  order_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) order_[i] = left_order(boxes_[i].x0, i);
  sort_by_left(order_);
  const std::size_t padded = n + 2 * kLanes;
  std::vector<std::int16_t> sides(3 * padded);
  std::int16_t *x0 = sides.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::size_t k = 0; k < padded; ++k) {
    constexpr std::int16_t kLast = std::numeric_limits<std::int16_t>::max();
    const Box b = k < n ? boxes_[static_cast<std::uint32_t>(order_[k])] : Box{kLast, kLast, kLast, -1};
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  order_.resize(padded);
  std::vector<std::array<std::uint32_t, 2>> pairs(4 * padded);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto s = static_cast<std::uint32_t>(order_[i]);
    const std::int16_t right = boxes_[s].x1;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i], far = Lanes{} + right;
    for (std::size_t j = i + 1; x0[j] <= right; j += kLanes) {
      const Lanes meets = (load_lanes(y0 + j) <= high) & (load_lanes(y1 + j) >= low) & (load_lanes(x0 + j) <= far);
      std::array<std::int16_t, kLanes> hits;
      std::array<std::uint64_t, 2> halves;
      std::memcpy(&hits, &meets, sizeof hits);
      std::memcpy(&halves, &meets, sizeof halves);
      if ((halves[0] | halves[1]) == 0) continue;
      if (count + kLanes > pairs.size()) pairs.resize(2 * pairs.size());
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        const auto t = static_cast<std::uint32_t>(order_[j + k]);
        pairs[count] = {std::min(s, t), std::max(s, t)};
        count -= static_cast<std::size_t>(static_cast<std::ptrdiff_t>(hits[k]));
      }
    }
  }
  pairs.resize(count);
  return pairs;
}

}  // namespace dymsum::planar
