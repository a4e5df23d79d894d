#include "planar/mask/interior_mask.h"

#include <algorithm>
#include <array>

namespace dymsum::planar {
namespace {

// Rasterizes with the centres' winding numbers or parities.
template <class Centres>
Raster rasterize(const Operand& o, const Grid& cells) {
  RasterMaker<Centres> maker(cells);
  const double rim = kRim * cells.cell;
  // No clamps are needed: coordinates are not negative, and the raster reaches farther than the operand by a cell.
  const auto cell = [&](double v) { return static_cast<int>(v * cells.per_cell); };
  bool has_area = false;
  for (const Loop& loop : o.loops) {
    const bool area = loop.kind == LoopKind::outer || loop.kind == LoopKind::hole;
    has_area |= area;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t t = o.next[i];
      const double ax = o.x[i], ay = o.y[i], bx = o.x[t], by = o.y[t];
      const int r0 = cell(std::min(ay, by) - rim), r1 = cell(std::max(ay, by) + rim);
      const int c0 = cell(std::min(ax, bx) - rim), c1 = cell(std::max(ax, bx) + rim);
      if (r1 - r0 <= 1 && c1 - c0 <= 1) {
        // Most edges of fine operands: the cells of both ends, and for the boundary the whole box.
        maker.touched().set(cell(ay), cell(ax));
        maker.touched().set(cell(by), cell(bx));
        if (!area) continue;
        maker.bound(r0, c0, c1);
        if (r1 != r0) maker.bound(r1, c0, c1);
      } else {
        maker.touch_edge(ax, ay, bx, by);
        if (!area) continue;
        maker.bound_edge(ax, ay, bx, by, kRim);
      }
      maker.wind_edge(ax, ay, bx, by);
    }
  }
  return has_area ? std::move(maker).with_area() : std::move(maker).without_area();
}

CoveredCells covered_cells_of(const Operand& p, const Operand& q, int cells) {
  const SumGrid grid({p.points->width, q.points->width}, {p.points->height, q.points->height}, cells);
  return CoveredCells(grid.whole, rasterize<CentreWindings>(p, grid.part[0]),
                      rasterize<CentreWindings>(q, grid.part[1]), CoveredCells::Counts::left_out);
}

}  // namespace

InteriorMask::InteriorMask(const Operand& p, const Operand& q, int cells)
    : CoveredCells(covered_cells_of(p, q, cells)), cells_(cells) {}

Raster fine_raster(const Operand& o, const Grid& cells) { return rasterize<CentreParities>(o, cells); }
Raster winding_raster(const Operand& o, const Grid& cells) { return rasterize<CentreWindings>(o, cells); }

}  // namespace dymsum::planar
