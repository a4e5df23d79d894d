// Coordinates rounded to a grid on request: what it moved, and which coordinates only rounding keeps off a grid.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The multiples of base^exponent, with the base 2 or 10. Multiples of powers of ten are meant as decimals: the nearest
/// doubles of them are on the grid.
struct CoordinateGrid {
  int base = 2;
  int exponent = 0;
  friend bool operator==(const CoordinateGrid&, const CoordinateGrid&) = default;
  std::string to_string() const;  ///< "2^-20", "1e-6"
};
/// The grid that a text names: 2^K with K from -1074 to 1000, or a power of ten up to 1, as 1e-6 or 0.001. Error
/// malformed for other texts.
Result<CoordinateGrid> coordinate_grid(const std::string& text);

struct SnapReport {
  std::size_t coordinates = 0;  ///< of all vertices
  std::size_t moved = 0;        ///< of these
  double largest_move = 0;      ///< of a coordinate
  std::string to_string() const;
};
template <class Data>
struct Snapped {
  Data data;
  SnapReport report;
};
/// Every coordinate rounded to the nearest multiple of the grid; halfway between two of them to the even one, of
/// decimals as they are written. Exact: no rounding before that one. The result is not validated: vertices may have
/// become one, edges may cross. Errors: not_finite; out_of_range for a grid of another base or exponent than above.
/// O(n).
Result<Snapped<RegionData>> snapped(RegionData data, const CoordinateGrid& grid);
Result<Snapped<MeshData>> snapped(MeshData data, const CoordinateGrid& grid);

/// Coordinates that rounding in doubles took off a grid.
struct CoordinateNoise {
  CoordinateGrid grid;
  std::size_t noisy = 0;        ///< coordinates that are off the grid, by no more than four ulps of the largest one
  std::size_t coordinates = 0;  ///< all of them
  std::string to_string() const;
};
/// The coarsest of the grids 1, 1/2, ..., 2^-20 and 1, 0.1, ..., 1e-9 that at least nine tenths of the coordinates are
/// on, or off it by no more than four ulps of the largest coordinate, if at least one of them is
/// off; nothing where there is none, or where that ulp is no finer than 2^-20 of the grid. A hint: exact sums of such
/// data take integers twice as long. O(n).
std::optional<CoordinateNoise> coordinate_noise(const RegionData& data);
std::optional<CoordinateNoise> coordinate_noise(const MeshData& data);

}  // namespace dymsum
