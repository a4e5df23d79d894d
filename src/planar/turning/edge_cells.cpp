#include "planar/turning/edge_cells.h"

#include <algorithm>

#include "planar/turning/turn_grid.h"

namespace dymsum::planar {

// A float errs by at most kReach, as there are fewer than 2048 rows and columns: that of the edge, that of the vertex,
// and their sum; and doubles by less than another one.
EdgeCells::EdgeCells(const TurningForms& forms, const CoveredCells& cells, const std::vector<Point>& turned,
                     std::span<const Point> reach)
    : cells_(cells) {
  static_assert(1024 * exact::kFloatRoundoff <= kReach);
  const Grid& g = cells.grid();
  last_ = Whole{g.rows - 1, g.columns - 1, g.rows - 1, g.columns - 1};
  const double shift = forms.reach();
  const auto bounds = [&](double x0, double y0, double x1, double y1, Point by) {
    return Bounds{static_cast<float>((y0 - by.y) * g.per_cell), static_cast<float>((x0 - by.x) * g.per_cell),
                  static_cast<float>((y1 + by.y) * g.per_cell), static_cast<float>((x1 + by.x) * g.per_cell)};
  };
  for (const std::uint32_t side : {0u, 1u}) {
    const Operand &o = forms.operand(side), &other = forms.operand(1 - side);
    const std::vector<Point>&at = side == 0 ? forms.points(0) : turned, &from = side == 0 ? turned : forms.points(0);
    edges_[side].reserve(o.size());
    for (std::uint32_t e = 0; e < o.size(); ++e) {
      const Point a = at[e], b = at[o.next[e]];
      const Point by = side == 0 ? Point{} : farther(reach[e], reach[o.next[e]]);
      edges_[side].push_back(bounds(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y),
                                    farther_by(by, 4 * kReach * g.cell)));
    }
    vertices_[side].reserve(other.size());
    for (std::uint32_t v = 0; v < other.size(); ++v) {
      const double x = from[v].x + shift, y = from[v].y + shift;
      vertices_[side].push_back(bounds(x, y, x, y, side == 0 ? reach[v] : Point{}));
    }
  }
}

}  // namespace dymsum::planar
