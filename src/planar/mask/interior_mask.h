// A proof, cell by cell, that parts of the plane lie in the interior of the sum: whatever happens there need not be
// computed. Lemma and proof: docs/design/planar-sum.md, "interior mask".
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "planar/operand/operand.h"

namespace dymsum::planar {

// A uniform grid over the plane of sums, and the cells a segment meets.

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

// The part of a segment that lies in a box, for pieces of segments in cells of a grid.

/// A segment from (x, y) with a vector, to be clipped by many boxes.
class SegmentClip {
 public:
  SegmentClip(double x, double y, double dx, double dy) : x_(x), y_(y), per_x_(1 / dx), per_y_(1 / dy) {}

  /// Fractions of the segment; nothing of it where from > to. Each errs by three roundings.
  struct Part {
    double from = 0, to = 1;
    double midpoint() const { return 0.5 * (from + to); }
  };
  /// What lies in [x0, x1] x [y0, y1].
  Part within(double x0, double y0, double x1, double y1) const {
    Part part;
    meet(part, x0 - x_, x1 - x_, per_x_);
    meet(part, y0 - y_, y1 - y_, per_y_);
    return part;
  }

 private:
  static void meet(Part& part, double low, double high, double per) {
    if (std::isinf(per)) {  // upright or level: all of it or nothing
      if (low > 0 || high < 0) part.to = -1;
      return;
    }
    const double u = low * per, v = high * per;
    part.from = std::max(part.from, std::min(u, v));
    part.to = std::min(part.to, std::max(u, v));
  }
  double x_, y_, per_x_, per_y_;
};

// Rasters of two operands on one grid, and the cells of the sum that they prove to lie inside it. Shared by the mask of
// one sum and the mask of a range of scales.

/// Rows of cells, 64 to a word.
struct Bitmap {
  int rows = 0, columns = 0;
  std::size_t words = 0;
  std::vector<std::uint64_t> bits;

  Bitmap(int r, int c) : rows(r), columns(c), words((c + 63) / 64), bits(words * r, 0) {}
  std::uint64_t* row(int r) { return bits.data() + words * r; }
  const std::uint64_t* row(int r) const { return bits.data() + words * r; }
  bool get(int r, int c) const { return (row(r)[c / 64] >> (c % 64)) & 1; }
  bool any() const {
    return std::any_of(bits.begin(), bits.end(), [](std::uint64_t w) { return w != 0; });
  }

  void set(int r, int c) { row(r)[c / 64] |= std::uint64_t{1} << (c % 64); }
  void set_run(int r, int first, int last) {
    std::uint64_t* w = row(r);
    const int a = first / 64, b = last / 64;
    const std::uint64_t head = ~std::uint64_t{0} << (first % 64), tail = ~std::uint64_t{0} >> (63 - last % 64);
    if (a == b) {
      w[a] |= head & tail;
      return;
    }
    w[a] |= head;
    for (int i = a + 1; i < b; ++i) w[i] = ~std::uint64_t{0};
    w[b] |= tail;
  }
};

/// One operand on the lattice of cells.
struct Raster {
  Raster(int rows, int columns) : inner(rows, columns), touch(rows, columns) {}
  Bitmap inner;  ///< cells that lie in the interior of a component, with a rim
  Bitmap touch;  ///< cells that provably hold a point of the operand, up to the rim
};

/// Boundary cells are those within 32 kReach cells of the boundary, so that an inner cell keeps a rim of that width.
inline constexpr double kRim = 32 * kReach;

/// Calls f(row, column) for every row of cells whose centre line an edge crosses, half-open in y, with the first cell
/// whose centre lies right of the edge; on which side one within a rounding of it is counted does not matter, as its
/// cell is a boundary cell.
template <class F>
void for_each_centre_line(const Grid& cells, double ax, double ay, double bx, double by, F&& f) {
  const double low = ay < by ? ay : by, high = ay < by ? by : ay;
  for (int r = static_cast<int>(low * cells.per_cell); r < cells.rows; ++r) {
    const double yc = (r + 0.5) * cells.cell;
    if (yc < low) continue;
    if (yc >= high) break;
    const double xc = ax + (yc - ay) * (bx - ax) / (by - ay);
    f(r, std::clamp(static_cast<int>(xc * cells.per_cell + 0.5), 0, cells.columns));
  }
}

/// Parities of the winding numbers at the centres of cells: components have 0 or 1, so that odd ones are positive.
class CentreParities {
 public:
  explicit CentreParities(const Grid& cells) : cells_(cells), change_(cells.rows, cells.columns) {}
  void add_edge(double ax, double ay, double bx, double by);
  /// Cells with odd winding number off the boundary are inner, and inner ones are touched.
  void fill(const Bitmap& boundary, Raster& raster) const;

 private:
  const Grid& cells_;
  Bitmap change_;
};

/// Winding numbers at the centres of cells, from the edges that cross the lines through them.
class CentreWindings {
 public:
  explicit CentreWindings(const Grid& cells)
      : cells_(cells), change_(std::size_t(cells.rows) * (cells.columns + 1), 0) {}
  void add_edge(double ax, double ay, double bx, double by);
  /// Cells with positive winding number off the boundary are inner, and inner ones are touched.
  void fill(const Bitmap& boundary, Raster& raster) const;

 private:
  const Grid& cells_;
  std::vector<int> change_;
};

/// A raster in the making, edge by edge; which cells an edge touches, and which are boundary cells, is determined by
/// who makes it. Centres: CentreWindings or CentreParities.
template <class Centres>
class RasterMaker {
 public:
  explicit RasterMaker(const Grid& cells)
      : cells_(cells), raster_(cells.rows, cells.columns), boundary_(cells.rows, cells.columns), centres_(cells) {}

  void touch(int row, int first, int last) { raster_.touch.set_run(row, first, last); }
  /// The cells that an edge comes into.
  void touch_edge(double ax, double ay, double bx, double by) {
    for_each_cell_run(cells_, ax, ay, bx, by, [&](int r, int first, int last) { touch(r, first, last); });
  }
  void bound(int row, int first, int last) { boundary_.set_run(row, first, last); }
  /// The cells within `rim` cells of an edge.
  void bound_edge(double ax, double ay, double bx, double by, double rim) {
    for_each_cell_run(
        cells_, ax, ay, bx, by, [&](int r, int first, int last) { bound(r, first, last); }, rim);
  }
  /// What lies on the left of an edge counts once more.
  void wind_edge(double ax, double ay, double bx, double by) { centres_.add_edge(ax, ay, bx, by); }

  Bitmap& touched() { return raster_.touch; }
  /// Nothing is inner where there is no area.
  Raster with_area() && {
    centres_.fill(boundary_, raster_);
    return std::move(raster_);
  }
  Raster without_area() && { return std::move(raster_); }

 private:
  const Grid& cells_;
  Raster raster_;
  Bitmap boundary_;
  Centres centres_;
};

/// Corners (i, j), between columns i - 1 and i and rows j - 1 and j, whose four cells are inner.
Bitmap inner_corners(const Bitmap& inner);

/// The grid of the sum with `cells` along the longer side, and the operands' parts of it.
struct SumGrid {
  SumGrid(std::array<double, 2> width, std::array<double, 2> height, int cells);
  Grid whole;
  std::array<Grid, 2> part;
};

/// The cells of the sum in which every point is one of int P + Q or P + int Q; docs/design/planar-sum.md, "interior
/// mask".
class CoveredCells {
 public:
  /// Whether live() will be asked.
  enum class Counts { made, left_out };

  /// No cell is covered.
  explicit CoveredCells(const Grid& grid, Counts counts = Counts::made);
  CoveredCells(const Grid& grid, const Raster& p, const Raster& q, Counts counts = Counts::made);
  /// Others that lie inside. Counts are not made again.
  void add(const Bitmap& inside);

  const Grid& grid() const { return grid_; }
  bool covered(int row, int column) const { return covered_.get(row, column); }
  /// One more cell, proved otherwise. Counts are not made again.
  void cover(int row, int column) { covered_.set(row, column); }
  /// Whether some cell of a rectangle is live. O(rows) for up to 64 columns; a live cell in the first rows ends it.
  bool any_live(int row0, int column0, int row1, int column1) const {
    return any(row0, column0, row1, column1, ~std::uint64_t{0});
  }
  /// Whether some cell of a rectangle is covered. As expensive.
  bool any_covered(int row0, int column0, int row1, int column1) const { return any(row0, column0, row1, column1, 0); }
  /// How many cells of a rectangle are live. O(1). Requires: the counts were made.
  std::uint32_t live(int row0, int column0, int row1, int column1) const {
    const std::size_t w = std::size_t(grid_.columns) + 1;
    const auto at = [&](int r, int c) { return sums_[std::size_t(r) * w + c]; };
    return at(row1 + 1, column1 + 1) - at(row0, column1 + 1) - at(row1 + 1, column0) + at(row0, column0);
  }
  std::size_t covered_cells() const { return covered_cells_; }
  std::size_t bytes() const { return covered_.bits.size() * 8 + sums_.size() * 4; }

 private:
  void count();
  // Whether some cell of a rectangle is covered, or with `flip` all ones live.
  bool any(int row0, int column0, int row1, int column1, std::uint64_t flip) const {
    const int a = column0 / 64, b = column1 / 64;
    const std::uint64_t head = ~std::uint64_t{0} << (column0 % 64), tail = ~std::uint64_t{0} >> (63 - column1 % 64);
    for (int r = row0; r <= row1; ++r) {
      const std::uint64_t* w = covered_.row(r);
      if (a == b) {
        if (((w[a] ^ flip) & head & tail) != 0) return true;
        continue;
      }
      if (((w[a] ^ flip) & head) != 0 || ((w[b] ^ flip) & tail) != 0) return true;
      for (int i = a + 1; i < b; ++i)
        if ((w[i] ^ flip) != 0) return true;
    }
    return false;
  }

  Grid grid_;
  Bitmap covered_;
  std::vector<std::uint32_t> sums_;  // live cells left of and below a corner
  std::size_t covered_cells_ = 0;
};

/// Cells whose closure, grown by 8 kReach cells, lies in int P + Q or P + int Q. Without counts.
class InteriorMask : public CoveredCells {
 public:
  /// `cells` along the longer side of the sum's bounding box.
  InteriorMask(const Operand& p, const Operand& q, int cells);
  int cells() const { return cells_; }

 private:
  int cells_;
};

/// An operand on fine cells: O(cells / 64 + rows met by edges) instead of O(cells). Where components overlap some inner
/// cells are missed.
Raster fine_raster(const Operand& o, const Grid& cells);
/// The same for any cells, by winding numbers. O(cells).
Raster winding_raster(const Operand& o, const Grid& cells);

}  // namespace dymsum::planar
