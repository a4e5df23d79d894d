// The edge across whose arc a circle leaves a cell, for cells of at most eight edges: all sides at once, in floats.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// A vertex's edges and the unit normals on their left, counter-clockwise, in floats. The last ones are repeated up to
/// eight, which changes nothing: a circle that goes round sees no change of sides there. More than eight are not kept:
/// not-a-numbers then, of which no side is proved.
struct alignas(32) RingOfEight {
  std::array<float, 8> x, y, z;
  std::array<std::uint32_t, 8> edge;
};
static_assert(sizeof(RingOfEight) == 128);

/// Where floats are certain of a side: normals, directions, three products and two sums each have relative errors of at
/// most 2^-24, in all at most 6 2^-24 of sum |n_i a_i| <= |a|, and what underflows is far below that.
constexpr double kFloatError = 0x1p-20;

constexpr std::uint32_t kNoEdge = ~std::uint32_t{0};

inline std::array<float, 3> in_floats(Vec3 a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// The sides of the circle of directions perpendicular to `along`.
struct EightSides {
  std::uint32_t left = 0;  ///< bit k: the normal on the left of edge k lies on the left
  bool proved = false;     ///< of all of them
  bool operator==(const EightSides&) const = default;
};

/// Requires, like all below: error >= kFloatError |along|.
inline EightSides eight_sides_one_by_one(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  EightSides sides{0, true};
  for (std::size_t k = 0; k < 8; ++k) {
    const float side = ring.x[k] * along[0] + ring.y[k] * along[1] + ring.z[k] * along[2];
    sides.left |= std::uint32_t{!std::signbit(side)} << k;
    sides.proved &= std::abs(side) > error;
  }
  return sides;
}

#if defined(__SSE2__)
/// The same.
inline EightSides eight_sides(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  const __m128 x = _mm_set1_ps(along[0]), y = _mm_set1_ps(along[1]), z = _mm_set1_ps(along[2]);
  const auto four = [&](std::size_t k) {
    return _mm_add_ps(_mm_add_ps(_mm_mul_ps(_mm_load_ps(&ring.x[k]), x), _mm_mul_ps(_mm_load_ps(&ring.y[k]), y)),
                      _mm_mul_ps(_mm_load_ps(&ring.z[k]), z));
  };
  const __m128 low = four(0), high = four(4), least = _mm_set1_ps(error), sign = _mm_set1_ps(-0.0F);
  const __m128 proved =
      _mm_and_ps(_mm_cmpgt_ps(_mm_andnot_ps(sign, low), least), _mm_cmpgt_ps(_mm_andnot_ps(sign, high), least));
  const int right = _mm_movemask_ps(low) | (_mm_movemask_ps(high) << 4);
  return {~static_cast<std::uint32_t>(right) & 0xFF, _mm_movemask_ps(proved) == 0xF};
}
#else
inline EightSides eight_sides(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  return eight_sides_one_by_one(ring, along, error);
}
#endif

/// The edge across whose arc the circle leaves the cell: the normal on the left of the edge lies on the left of the
/// circle, the one before it on the right. kNoEdge where floats cannot decide, or where there is none.
inline std::uint32_t leaving_edge(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  const auto [left, proved] = eight_sides(ring, along, error);
  const std::uint32_t exits = left & ~((left << 1) | (left >> 7));
  return proved && exits != 0 ? ring.edge[static_cast<std::size_t>(std::countr_zero(exits))] : kNoEdge;
}

}  // namespace dymsum::spatial
