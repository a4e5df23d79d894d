// Vectors and points in space: of doubles for filters, pictures and reports, on which no decision rests alone; exact
// ones, rounded; points of meshes on their grid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/algebraic_root.h"
#include "exact/big.h"
#include "exact/fraction.h"
#include "exact/grid.h"
#include "exact/int.h"
#include "exact/interval.h"

namespace dymsum::spatial {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double sum_of_sizes(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Three rows.
using Mat3 = std::array<Vec3, 3>;
inline Vec3 operator*(const Mat3& m, Vec3 v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
/// The row vector v m.
inline Vec3 row_times(Vec3 v, const Mat3& m) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }
inline Mat3 transposed(const Mat3& m) {
  return {Vec3{m[0].x, m[1].x, m[2].x}, Vec3{m[0].y, m[1].y, m[2].y}, Vec3{m[0].z, m[1].z, m[2].z}};
}
inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  return {row_times(a[0], b), row_times(a[1], b), row_times(a[2], b)};
}

// Exact vectors rounded to doubles, whatever their size.

/// |v| <= 2^bit_length(v); 0 for zero.
inline int bit_length(const exact::Big& v) {
  return sign(v) == 0 ? 0 : static_cast<int>(msb(exact::BigInteger(abs(v.value())))) + 1;
}
inline int bit_length(const exact::Vector3<exact::Big>& v) {
  return std::max({bit_length(v.x), bit_length(v.y), bit_length(v.z)});
}
template <int B>
int bit_length(const exact::Vector3<exact::Int<B>>& v) {
  const double most = std::max({std::abs(to_double(v.x)), std::abs(to_double(v.y)), std::abs(to_double(v.z))});
  return most == 0 ? 0 : std::ilogb(most) + 1;
}

/// 2^exponent v with a relative error below 2^-52, unless the result is beyond the range of doubles.
inline double rounded(const exact::Big& v, int exponent) {
  const int drop = std::max(0, bit_length(v) - 120);  // what is cut is below 2^-119 of the number
  const exact::BigInteger top = exact::BigInteger(abs(v.value())) >> static_cast<unsigned>(drop);
  return std::ldexp(to_double(exact::Big(top)) * (sign(v) < 0 ? -1.0 : 1.0), exponent + drop);
}
inline Vec3 rounded(const exact::Vector3<exact::Big>& v, int exponent) {
  return {rounded(v.x, exponent), rounded(v.y, exponent), rounded(v.z, exponent)};
}
/// The same. Requires -600 <= exponent <= 600, which keeps integers of up to 400 bits within the range of doubles.
template <int B>
double rounded(const exact::Int<B>& v, int exponent) {
  static_assert(B <= 400);
  return exact::power_of_two(exponent) * to_double(v);
}
template <int B>
Vec3 rounded(const exact::Vector3<exact::Int<B>>& v, int exponent) {
  return exact::power_of_two(exponent) * Vec3{to_double(v.x), to_double(v.y), to_double(v.z)};
}

/// The unit vector of an exact one that is not zero. Scaled by a power of two so that the largest component is about 1,
/// components err by 2^-52 of themselves, or by less than 2^-1074; the length has relative error below 2^-51: together
/// below 2^-50.
template <class T>
Vec3 unit(const exact::Vector3<T>& v) {
  const Vec3 d = rounded(v, -bit_length(v));
  const double size = length(d);
  return {d.x / size, d.y / size, d.z / size};
}

// Points of space as integers on their common lossless grid.

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
exact::FineInterval fine_coordinate(const exact::Fraction& v, int shift);
/// The same with all digits that a WideInterval has.
exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift);
exact::WideInterval wide_coordinate(const exact::Fraction& v, int shift);

// Points in the order of their coordinates, and which of them are at one position.

/// The indices of all points by x, then y, then z; those at one position by index. O(n log n).
std::vector<std::uint32_t> order_by_position(const std::vector<Point3>& points);

/// The first of the points at every one's position. O(n log n).
std::vector<std::uint32_t> first_at_position(const std::vector<Point3>& points);

}  // namespace dymsum::spatial
