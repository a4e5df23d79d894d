// Points of space as integers on their common lossless grid.
#pragma once

#include <cstddef>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/big.h"
#include "exact/grid.h"

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

}  // namespace dymsum::spatial
