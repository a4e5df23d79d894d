// A uniform grid over the plane of sums, and the cells a segment meets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dymsum::planar {

/// Cells [c h, (c + 1) h] x [r h, (r + 1) h], 0 <= c < columns, 0 <= r < rows.
struct Grid {
  double cell = 1, per_cell = 1;
  int columns = 1, rows = 1;

  int column(double x) const { return std::clamp(static_cast<int>(x * per_cell), 0, columns - 1); }
  int row(double y) const { return std::clamp(static_cast<int>(y * per_cell), 0, rows - 1); }
};

/// Cells along the longer side of a sum for n segments: finer grids cost more in the mask than they save in pairs.
inline int grid_size(std::size_t n) {
  constexpr double kCellsPerRoot = 2;
  return std::clamp(static_cast<int>(kCellsPerRoot * std::sqrt(static_cast<double>(n))), 8, 1024);
}

/// How far beyond a segment its cells are still visited, in cells. Doubles err by at most 2^-50 of the grid's extent,
/// which is at most 2^-38 of a cell for up to 2^12 cells; interpolation along a segment of slope up to 2^12 keeps that
/// below 2^-24.
inline constexpr double kReach = 0x1p-14;

/// Calls f(row, first column, last column) for every row, such that every cell within `cells` of the segment is visited
/// (`cells` times the size of a cell), and no cell farther than 4 times that. Requires finite coordinates, cells >=
/// kReach.
template <class F>
void for_each_cell_run(const Grid& grid, double ax, double ay, double bx, double by, F&& f, double cells = kReach) {
  if (ay > by) {
    std::swap(ax, bx);
    std::swap(ay, by);
  }
  const double reach = cells * grid.cell;
  const int r0 = grid.row(ay - reach), r1 = grid.row(by + reach);
  const double x_low = std::min(ax, bx), x_high = std::max(ax, bx);
  if (r0 == r1) {
    f(r0, grid.column(x_low - reach), grid.column(x_high + reach));
    return;
  }
  // by - ay may be tiny where the segment only grazes a second row: then the clamps make both runs the whole segment.
  const double slope = (bx - ax) / (by - ay);
  for (int r = r0; r <= r1; ++r) {
    const double y0 = r * grid.cell - reach, y1 = (r + 1) * grid.cell + reach;
    double x0 = y0 <= ay ? ax : std::clamp(ax + (y0 - ay) * slope, x_low, x_high);
    double x1 = y1 >= by ? bx : std::clamp(ax + (y1 - ay) * slope, x_low, x_high);
    if (x0 > x1) std::swap(x0, x1);
    f(r, grid.column(x0 - reach), grid.column(x1 + reach));
  }
}

}  // namespace dymsum::planar
