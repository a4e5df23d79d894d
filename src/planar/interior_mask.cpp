#include "planar/interior_mask.h"

#include <algorithm>
#include <array>

namespace dymsum::planar {
namespace {

Raster rasterize(const Operand& o, const Grid& cells) {
  Raster raster(cells.rows, cells.columns);
  Bitmap boundary(cells.rows, cells.columns);
  CentreWindings windings(cells);
  const double rim = kRim * cells.cell;
  bool has_area = false;
  for (const Loop& loop : o.loops) {
    const bool area = loop.kind == LoopKind::outer || loop.kind == LoopKind::hole;
    has_area |= area;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t t = o.next[i];
      const double ax = o.x[i], ay = o.y[i], bx = o.x[t], by = o.y[t];
      const int r0 = cells.row(std::min(ay, by) - rim), c0 = cells.column(std::min(ax, bx) - rim);
      if (r0 == cells.row(std::max(ay, by) + rim) && c0 == cells.column(std::max(ax, bx) + rim)) {
        // Inside one cell with its rim: the common case of fine operands.
        raster.touch.set_run(r0, c0, c0);
        if (area) boundary.set_run(r0, c0, c0);
        if (!area || (ay - (r0 + 0.5) * cells.cell < 0) == (by - (r0 + 0.5) * cells.cell < 0)) continue;
      } else {
        for_each_cell_run(cells, ax, ay, bx, by, [&](int r, int first, int last) { raster.touch.set_run(r, first, last); });
        if (!area) continue;
        for_each_cell_run(cells, ax, ay, bx, by, [&](int r, int first, int last) { boundary.set_run(r, first, last); }, kRim);
      }
      windings.add_edge(ax, ay, bx, by);
    }
  }
  if (has_area) windings.fill(boundary, raster);
  return raster;
}

DeadCells dead_cells_of(const Operand& p, const Operand& q, int cells) {
  const SumGrid grid({p.points->width, q.points->width}, {p.points->height, q.points->height}, cells);
  return DeadCells(grid.whole, rasterize(p, grid.part[0]), rasterize(q, grid.part[1]));
}

}  // namespace

InteriorMask::InteriorMask(const Operand& p, const Operand& q, int cells) : DeadCells(dead_cells_of(p, q, cells)) {}

}  // namespace dymsum::planar
