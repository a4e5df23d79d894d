#include "planar/turning/turn_grid.h"

#include <algorithm>

#include "planar/mask/segment_clip.h"
#include "planar/turning/edge_parallelograms.h"

namespace dymsum::planar {
namespace {

Raster fixed_raster(const TurningForms& forms, const Grid& cells) {
  const Operand& o = forms.operand(0);
  RasterMaker<CentreParities> maker(cells);
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = forms.points(0)[i], b = forms.points(0)[o.next[i]];
    maker.touch_edge(a.x, a.y, b.x, b.y);
    maker.bound_edge(a.x, a.y, b.x, b.y, kRim);
    maker.wind_edge(a.x, a.y, b.x, b.y);
  }
  return std::move(maker).with_area();
}

}  // namespace

TurnGrid::TurnGrid(const TurningForms& forms, int cells, std::size_t most_long_edges)
    : forms(forms),
      grid({forms.width(), 2 * forms.reach()}, {forms.height(), 2 * forms.reach()}, cells),
      fixed(fixed_raster(forms, grid.part[0])),
      cells(cells),
      long_edges{dymsum::planar::long_edges(forms, 0, grid.whole.cell, most_long_edges),
                 dymsum::planar::long_edges(forms, 1, grid.whole.cell, most_long_edges)} {}

// Inner: farther from the boundary than any of its points moves. Touched at every angle: at the middle, an edge comes
// into what remains of the cell when a rim as wide as the edge moves is taken off.
CoveredCells covered_cells(const TurnGrid& base, const std::vector<Point>& turned, double half) {
  const TurningForms& forms = base.forms;
  const Grid& cells = base.grid.part[1];
  const Operand& o = forms.operand(1);
  RasterMaker<CentreParities> maker(cells);
  const double shift = forms.reach();
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a{turned[i].x + shift, turned[i].y + shift},
        b{turned[o.next[i]].x + shift, turned[o.next[i]].y + shift};
    const Point reach =
        farther_by(farther(moved_by(turned[i], half), moved_by(turned[o.next[i]], half)), kSweptRim * forms.span());
    maker.bound_edge(a.x, a.y, b.x, b.y, kRim + std::max(reach.x, reach.y) * cells.per_cell);
    maker.wind_edge(a.x, a.y, b.x, b.y);
    if (2 * reach.x >= cells.cell || 2 * reach.y >= cells.cell) continue;
    const SegmentClip clip(a.x, a.y, b.x - a.x, b.y - a.y);
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) {
      for (int c = first; c <= last; ++c) {
        const SegmentClip::Part part = clip.within(c * cells.cell + reach.x, r * cells.cell + reach.y,
                                                   (c + 1) * cells.cell - reach.x, (r + 1) * cells.cell - reach.y);
        if (part.from <= part.to) maker.touch(r, c, c);
      }
    });
  }
  const Raster raster = std::move(maker).with_area();
  CoveredCells dead(base.grid.whole, base.fixed, raster, CoveredCells::Counts::left_out);
  if (!base.long_edges[0].empty() && !base.long_edges[1].empty()) dead.add(edge_parallelograms(base, turned, half));
  return dead;
}

}  // namespace dymsum::planar
