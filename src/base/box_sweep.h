// The pairs of many boxes that meet: in the order of their left sides, eight at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/box_lanes.h"
#include "base/scratch.h"

namespace dymsum {

/// A box in quanta below kBoxQuanta.
struct BoxQuanta {
  std::int16_t x0, y0, x1, y1;
};

/// Goes through every box k in the order of their left sides: first requests wanted = wanted_by(k, i), k being the
/// i-th; then calls meet(k, others) with those that start no earlier, meet it and are wanted(other). Returns how many
/// pairs were compared.
template <class WantedBy, class Meet>
std::uint64_t sweep_boxes(std::span<const BoxQuanta> boxes, Scratch* memory, WantedBy&& wanted_by, Meet&& meet) {
  const auto n = static_cast<std::uint32_t>(boxes.size());
  Array<std::uint64_t> order(n, memory);
  for (std::uint32_t k = 0; k < n; ++k) order[k] = left_order(boxes[k].x0, k);
  sort_by_left(order);
  // After the last box lie some that start to the right of everything and meet nothing.
  const std::size_t padded = std::size_t{n} + 2 * kLanes;
  Array<std::int16_t> sides(3 * padded, memory);
  std::int16_t *x0 = sides.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::uint32_t k = 0; k < n; ++k) {
    const BoxQuanta& b = boxes[order[k] & 0xffffffff];
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  for (std::size_t k = n; k < padded; ++k) {
    x0[k] = y0[k] = std::numeric_limits<std::int16_t>::max();
    y1[k] = -1;
  }
  Array<std::uint32_t> near(std::size_t{n} + 1, memory);
  std::uint64_t compared = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::uint32_t>(order[i]);
    const auto wanted = wanted_by(k, i);
    const std::int16_t right = boxes[k].x1;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i];
    std::uint32_t* hit = near.data();
    std::uint32_t j = i + 1;
    for (; x0[j] <= right; j += kLanes) {
      const Lanes apart = (load_lanes(y0 + j) > high) | (low > load_lanes(y1 + j));
      for (auto hits = zero_lanes(apart); hits != 0; hits &= hits - 1) {
        const auto other = static_cast<std::uint32_t>(order[j + lane_of(hits)]);
        *hit = other;
        hit += static_cast<std::uint32_t>(wanted(other));
      }
    }
    compared += j - i - 1;
    meet(k, std::span<const std::uint32_t>(near.data(), hit));
  }
  return compared;
}

}  // namespace dymsum
