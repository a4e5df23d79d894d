// Points of space as integers on their common lossless grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/algebraic_root.h"
#include "exact/big.h"
#include "exact/grid.h"
#include "exact/interval.h"
#include "exact/vector3.h"

namespace dymsum::spatial {

template <class C>
struct GridPoint {
  C x, y, z;
};

template <class A, class B>
auto operator-(const GridPoint<A>& a, const GridPoint<B>& b) {
  return GridPoint<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The grid of a list of points: units 2^exponent and an offset that is a multiple of them, for every axis by itself,
/// and the bits that the coordinates need.
struct SpaceGrid {
  struct Line {
    int exponent = 0;
    double offset = 0;
    int bits = 0;
  };
  Line x, y, z;

  exact::Tier tier() const;
};
/// Requires finite coordinates. O(n).
SpaceGrid space_grid(const std::vector<Point3>& points);

template <class C>
std::vector<GridPoint<C>> grid_points(const std::vector<Point3>& points, const SpaceGrid& g) {
  using exact::grid_coordinate;
  std::vector<GridPoint<C>> on_grid;
  on_grid.reserve(points.size());
  for (const Point3& p : points) {
    on_grid.push_back({grid_coordinate<C>(p.x, g.x.offset, g.x.exponent),
                       grid_coordinate<C>(p.y, g.y.offset, g.y.exponent),
                       grid_coordinate<C>(p.z, g.z.offset, g.z.exponent)});
  }
  return on_grid;
}

/// f(points on the grid) with the narrowest number type of the tiers that holds them: Int<29>, Int<61>, Int<125>, Big.
template <class F>
auto with_grid_points(const std::vector<Point3>& points, const SpaceGrid& grid, F f) {
  using exact::Tier;
  switch (grid.tier()) {
    case Tier::b29:
      return f(grid_points<exact::Int<29>>(points, grid));
    case Tier::b61:
      return f(grid_points<exact::Int<61>>(points, grid));
    case Tier::b512:
      return f(grid_points<exact::Int<125>>(points, grid));
    case Tier::arbitrary:
      break;
  }
  return f(grid_points<exact::Big>(points, grid));
}

// Positions of space as integers on one lossless grid, the same for all axes.

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

// Integers of any size as intervals of thirty digits, or of seventy.

/// v 2^shift. Requires that to be at most 1 in magnitude.
exact::FineInterval fine_coordinate(const exact::Big& v, int shift);
/// The same of a value at a root.
exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift);
/// The same with all digits that a WideInterval has.
exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift);

// Points in the order of their coordinates, and which of them are at one position.

/// The indices of all points by x, then y, then z; those at one position by index. O(n log n).
std::vector<std::uint32_t> order_by_position(const std::vector<Point3>& points);

/// The first of the points at every one's position. O(n log n).
std::vector<std::uint32_t> first_at_position(const std::vector<Point3>& points);

}  // namespace dymsum::spatial
