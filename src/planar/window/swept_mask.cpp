// Cells that stay covered throughout a window of scales.
#include <algorithm>
#include <array>

#include "planar/window/scaling_stages.h"

namespace dymsum::planar {
namespace {

struct Place2 {
  double x, y;
};

// Calls f(row, first column, last column) for the cells within `reach` of the convex quadrangle swept by a segment a b
// from its position a0 b0 at one end of the window to a1 b1 at the other.
template <class F>
void for_each_swept_run(const Grid& grid, const double (&x)[4], const double (&y)[4], double reach, F&& f) {
  double y_low = y[0], y_high = y[0], x_low = x[0], x_high = x[0];
  for (int k = 1; k < 4; ++k) {
    y_low = y[k] < y_low ? y[k] : y_low;
    y_high = y[k] > y_high ? y[k] : y_high;
    x_low = x[k] < x_low ? x[k] : x_low;
    x_high = x[k] > x_high ? x[k] : x_high;
  }
  const int r0 = grid.row(y_low - reach), r1 = grid.row(y_high + reach);
  if (r0 == r1) {
    f(r0, grid.column(x_low - reach), grid.column(x_high + reach));
    return;
  }
  for (int r = r0; r <= r1; ++r) {
    const double low = r * grid.cell - reach, high = (r + 1) * grid.cell + reach;
    double left = x_high, right = x_low;
    for (int k = 0; k < 4; ++k) {
      const int l = (k + 1) & 3;
      double ax = x[k], ay = y[k], bx = x[l], by = y[l];
      if (ay > by) {
        std::swap(ax, bx);
        std::swap(ay, by);
      }
      if (by < low || ay > high) continue;
      // by - ay may be tiny: then the clamps make the whole edge.
      const double slope = by > ay ? (bx - ax) / (by - ay) : 0;
      const double e0 = ax < bx ? ax : bx, e1 = ax < bx ? bx : ax;
      const double u = ay >= low ? ax : std::clamp(ax + (low - ay) * slope, e0, e1);
      const double v = by <= high ? bx : std::clamp(ax + (high - ay) * slope, e0, e1);
      left = std::min({left, u, v});
      right = std::max({right, u, v});
    }
    if (left <= right) f(r, grid.column(left - reach), grid.column(right + reach));
  }
}

// An edge that meets a cell at both ends of the window meets it in between: its positions form a plane piece in (x, y,
// tau), which is convex.
void touch_at_both_ends(const Grid& cells, Place2 a0, Place2 b0, Place2 a1, Place2 b1,
                        std::vector<std::array<int, 3>>& scratch, Bitmap& touch) {
  scratch.clear();
  for_each_cell_run(cells, a0.x, a0.y, b0.x, b0.y, [&](int r, int first, int last) {
    scratch.push_back({r, first, last});
  });
  for_each_cell_run(cells, a1.x, a1.y, b1.x, b1.y, [&](int r, int first, int last) {
    const int k = r - scratch[0][0];
    if (k < 0 || k >= static_cast<int>(scratch.size())) return;
    const int from = std::max(first, scratch[k][1]), to = std::min(last, scratch[k][2]);
    if (from <= to) touch.set_run(r, from, to);
  });
}

template <class At>
Raster rasterize(const Operand& o, const Grid& cells, bool moves, const At& at) {
  RasterMaker<CentreParities> maker(cells);
  std::vector<std::array<int, 3>> scratch;
  const double rim = kRim * cells.cell;
  for (const Loop& loop : o.loops)
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t s = o.source[i], t = o.source[o.next[i]];
      const Place2 a0 = at(s, 0), b0 = at(t, 0), a1 = moves ? at(s, 1) : a0, b1 = moves ? at(t, 1) : b0;
      const double x[4] = {a0.x, b0.x, b1.x, a1.x}, y[4] = {a0.y, b0.y, b1.y, a1.y};
      for_each_swept_run(cells, x, y, rim, [&](int r, int first, int last) { maker.bound(r, first, last); });
      touch_at_both_ends(cells, a0, b0, a1, b1, scratch, maker.touched());
      maker.wind_edge(a0.x, a0.y, b0.x, b0.y);
    }
  return std::move(maker).with_area();
}

}  // namespace

CoveredCells swept_cells(const OperandPair& base, const WindowFrame& frame, int cells, bool use) {
  std::array<double, 2> width = base.width, height = base.height;
  width[frame.moving] *= frame.tau1;
  height[frame.moving] *= frame.tau1;
  const SumGrid grid(width, height, cells);
  if (!use) return CoveredCells(grid.whole);
  const auto raster = [&](std::uint32_t op) {
    const std::vector<double>&x = base.lattice->points[op]->x, &y = base.lattice->points[op]->y;
    if (op != frame.moving)
      return rasterize(base.operands[op], grid.part[op], false, [&](std::uint32_t v, int) {
        return Place2{x[v], y[v]};
      });
    return rasterize(base.operands[op], grid.part[op], true, [&](std::uint32_t v, int end) {
      const double tau = end == 0 ? frame.tau0 : frame.tau1;
      return Place2{tau * x[v] + frame.shift_x(tau), tau * y[v] + frame.shift_y(tau)};
    });
  };
  return CoveredCells(grid.whole, raster(0), raster(1), CoveredCells::Counts::left_out);
}

}  // namespace dymsum::planar
