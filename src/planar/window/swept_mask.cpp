#include "planar/window/swept_mask.h"

#include <algorithm>
#include <array>

namespace dymsum::planar {
namespace {

struct Place2 {
  double x, y;
};

// An edge that meets a cell at both ends of the window meets it in between: its places form a plane piece in (x, y,
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

CoveredCells covered_cells_of(const Lattice& unscaled, const std::array<Operand, 2>& operands, const WindowFrame& frame,
                              int cells, bool use) {
  std::array<double, 2> width{unscaled.points[0]->width, unscaled.points[1]->width};
  std::array<double, 2> height{unscaled.points[0]->height, unscaled.points[1]->height};
  width[frame.moving] *= frame.tau1;
  height[frame.moving] *= frame.tau1;
  const SumGrid grid(width, height, cells);
  if (!use) return CoveredCells(grid.whole);
  const auto raster = [&](std::uint32_t op) {
    const std::vector<double>&x = unscaled.points[op]->x, &y = unscaled.points[op]->y;
    if (op != frame.moving)
      return rasterize(operands[op], grid.part[op], false, [&](std::uint32_t v, int) { return Place2{x[v], y[v]}; });
    return rasterize(operands[op], grid.part[op], true, [&](std::uint32_t v, int end) {
      const double tau = end == 0 ? frame.tau0 : frame.tau1;
      return Place2{tau * x[v] + frame.shift_x(tau), tau * y[v] + frame.shift_y(tau)};
    });
  };
  return CoveredCells(grid.whole, raster(0), raster(1), CoveredCells::Counts::left_out);
}

}  // namespace

SweptMask::SweptMask(const Lattice& unscaled, const std::array<Operand, 2>& operands, const WindowFrame& frame,
                     int cells, bool use)
    : CoveredCells(covered_cells_of(unscaled, operands, frame, cells, use)) {}

}  // namespace dymsum::planar
