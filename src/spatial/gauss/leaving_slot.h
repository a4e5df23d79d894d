// The edge of a cell across which an arc leaves it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// The edge at a vertex of many edges, see below: runs of faces on one side of the circle are passed at once. It is
/// kept out of the loops that walk, which it would slow down.
template <class Value, class Sign>
[[gnu::noinline]] std::uint32_t leaving_slot_of_many(const Polytope& other, std::uint32_t v, const RingBounds& bounds,
                                                     Vec3 along, double error, const Value& value, const Sign& sign) {
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  const auto is_left = [&](std::uint32_t k) {
    const double side = value(begin + k);
    return std::abs(side) > error ? side > 0 : sign(begin + k) > 0;
  };
  std::uint32_t exit = size;
  bool right = is_left(size - 1);
  bounds.signs(along, error, [&](std::uint32_t first, std::uint32_t last, int side) {
    for (std::uint32_t k = first; k < last && exit == size; ++k) {
      const bool left = side == 0 ? is_left(k) : side > 0;
      if (left && !right) exit = k;
      right = left;
      if (side != 0) break;  // all alike
    }
    return exit != size;
  });
  if (exit == size) throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
  return begin + exit;
}

/// An arc that enters the cell of vertex v of `other` and does not end there leaves it across the arc of the half-edge
/// from v whose left face lies on the left of the arc's circle and whose right face lies on its right: the circle
/// crosses the boundary of a convex cell once outwards. Its slot in the ring. `value(slot)` is, within `error`, on
/// which side the face on the left of a slot lies, its product with `along`; `sign(slot)` says it exactly.
template <class Value, class Sign>
std::uint32_t leaving_slot(const Polytope& other, std::uint32_t v, Vec3 along, double error, const Value& value,
                           const Sign& sign) {
  if (const RingBounds* bounds = other.bounds(other.normal_bounds, v))
    return leaving_slot_of_many(other, v, *bounds, along, error, value, sign);
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  // Bit k: the face on the left of half-edge k of the ring lies on the left of the circle; the face on its right is
  // that of the one before it.
  static_assert(RingBounds::kManyEdges <= 64);
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
  throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
}

}  // namespace dymsum::spatial
