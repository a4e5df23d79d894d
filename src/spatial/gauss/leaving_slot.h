// Where an arc leaves a cell.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// An arc that enters the cell of vertex v of `other` and does not end there leaves it across the arc of the half-edge
/// from v whose left face lies on the left of the arc's circle and whose right face lies on its right: the circle
/// crosses the border of a convex cell once outwards. Its slot in the ring. `value(slot)` is, within `error`, on which
/// side the face on the left of a slot lies, `sign(slot)` says it exactly.
template <class Value, class Sign>
std::uint32_t leaving_slot(const Polytope& other, std::uint32_t v, double error, const Value& value, const Sign& sign) {
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  // Bit k: the face on the left of half-edge k of the ring lies on the left of the circle; the face on its right is
  // that of the one before it.
  constexpr std::uint32_t kWord = 64;
  if (size <= kWord) {
    std::uint64_t left = 0, doubt = 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      const double side = value(begin + k);
      left |= std::uint64_t{side > 0} << k;
      doubt |= std::uint64_t{!(std::abs(side) > error)} << k;
    }
    for (; doubt != 0; doubt &= doubt - 1) {
      const int k = std::countr_zero(doubt);
      left &= ~(std::uint64_t{1} << k);
      left |= std::uint64_t{sign(begin + static_cast<std::uint32_t>(k)) > 0} << k;
    }
    const std::uint64_t right = (left << 1) | (left >> (size - 1));
    const std::uint64_t exits = left & ~right;
    if (exits != 0) return begin + static_cast<std::uint32_t>(std::countr_zero(exits));
  } else {
    bool right = sign(begin + size - 1) > 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      const bool left = sign(begin + k) > 0;
      if (left && !right) return begin + k;
      right = left;
    }
  }
  throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
}

}  // namespace dymsum::spatial
