// Positions of space as integers on one lossless grid, the same for all axes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/big.h"
#include "exact/vector3.h"

namespace dymsum::spatial {

struct GridPositions {
  std::vector<std::array<std::int64_t, 3>> grid;  // when bits <= 61
  std::vector<exact::Vector3<exact::Big>> big;    // otherwise
  int bits = 0;                                   // |coordinates| <= 2^bits
  int exponent = 0;                               // grid unit 2^exponent

  /// Coordinates of a position as a C. Requires that they fit.
  template <class C>
  exact::Vector3<C> position(std::uint32_t v) const {
    if constexpr (std::is_same_v<C, exact::Big>) {
      if (!big.empty()) return big[v];
    }
    return {C::from_int64(grid[v][0]), C::from_int64(grid[v][1]), C::from_int64(grid[v][2])};
  }
};

/// Requires finite coordinates.
GridPositions grid_positions(std::span<const Point3> points);
/// Multiples of 2^exponent.
GridPositions grid_positions(const std::vector<exact::Vector3<exact::Big>>& points, int exponent);

/// Calls f with a value of the narrowest coordinate type (Int<26>, Int<61> or Big) that holds the positions.
template <class F>
auto with_coordinates(const GridPositions& p, F&& f) {
  if (p.bits <= 26) return f(exact::Int<26>{});
  if (p.bits <= 61) return f(exact::Int<61>{});
  return f(exact::Big{});
}

}  // namespace dymsum::spatial
