// Cells of the plane of sums that lie in the open sum at every scale of a window: interior_mask.h for a moving operand.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/mask/covered_cells.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// How the moving operand's coordinate x stands at parameter tau in the window's frame: tau x + (tau1 - tau) centre.
/// The fixed operand's coordinates stand as they are. The frame moves with the operand's centre, so that sweeps are
/// half as long; it never enters an exact sign.
struct WindowFrame {
  std::uint32_t moving = 0;  ///< operand
  double tau0 = 1, tau1 = 1;
  double centre_x = 0, centre_y = 0;
  double shift_x(double tau) const { return (tau1 - tau) * centre_x; }
  double shift_y(double tau) const { return (tau1 - tau) * centre_y; }
};

/// Calls f(row, first column, last column) for the cells within `reach` of the convex quadrangle swept by a segment a b
/// from its place a0 b0 at one end of the window to a1 b1 at the other.
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

/// Dead cells: their closures, grown by 8 kReach cells, lie in int P + Q or P + int Q at every scale of the window.
class SweptMask : public CoveredCells {
 public:
  /// `cells` along the longer side. Without `use` no cell is dead and only the grid is made.
  SweptMask(const Lattice& unscaled, const std::array<Operand, 2>& operands, const WindowFrame& frame, int cells,
            bool use);
};

}  // namespace dymsum::planar
