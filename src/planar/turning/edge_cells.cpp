#include "planar/turning/edge_cells.h"

#include <algorithm>

namespace dymsum::planar {

// A float errs by at most kReach, as there are fewer than 2048 rows and columns: that of the edge, that of the vertex,
// and their sum; and doubles by less than another one.
EdgeCells::EdgeCells(const TurningForms& forms, const CoveredCells& cells, const std::vector<Point>& turned,
                     const std::vector<double>& reach)
    : cells_(cells) {
  static_assert(1024 * exact::kFloatRoundoff <= kReach);
  const Grid& g = cells.grid();
  last_ = Whole{g.rows - 1, g.columns - 1, g.rows - 1, g.columns - 1};
  const double shift = forms.reach();
  const auto bounds = [&](double x0, double y0, double x1, double y1, double by) {
    const double to = by * g.per_cell;
    return Bounds{static_cast<float>(y0 * g.per_cell - to), static_cast<float>(x0 * g.per_cell - to),
                  static_cast<float>(y1 * g.per_cell + to), static_cast<float>(x1 * g.per_cell + to)};
  };
  for (const std::uint32_t side : {0u, 1u}) {
    const Operand &o = forms.operand(side), &other = forms.operand(1 - side);
    const std::vector<Point>&at = side == 0 ? forms.points(0) : turned, &from = side == 0 ? turned : forms.points(0);
    edges_[side].reserve(o.size());
    for (std::uint32_t e = 0; e < o.size(); ++e) {
      const Point a = at[e], b = at[o.next[e]];
      edges_[side].push_back(bounds(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y),
                                    (side == 0 ? 0 : std::max(reach[e], reach[o.next[e]])) + 4 * kReach * g.cell));
    }
    vertices_[side].reserve(other.size());
    for (std::uint32_t v = 0; v < other.size(); ++v) {
      const double x = from[v].x + shift, y = from[v].y + shift;
      vertices_[side].push_back(bounds(x, y, x, y, side == 0 ? reach[v] : 0));
    }
  }
}

}  // namespace dymsum::planar
