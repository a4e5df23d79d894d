// Cells of the sum that stay inside it while an operand turns a little: what windows of angles are made with.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "planar/mask/covered_cells.h"
#include "planar/turning/turning_forms.h"

namespace dymsum::planar {

/// What does not depend on the window.
class TurnGrid {
 public:
  /// All pairs of the longest edges of either operand, some at most, are looked at for every window.
  TurnGrid(const TurningForms& forms, int cells, std::size_t most_long_edges = 24);
  const TurningForms& forms;
  SumGrid grid;
  Raster fixed;
  int cells;
  std::array<std::vector<std::uint32_t>, 2> long_edges;  ///< for edge_parallelograms
};

/// How far a vertex of the turning operand moves within `half` radians, at most; the chord is shorter than the arc.
inline double moved(const TurningForms& forms, std::uint32_t v, double half) {
  return forms.radius(v) * half * exact::kOutwards;
}

/// How far a vertex at p, about the centre of the turn, moves in either axis within `half` radians, at most: by
/// p (cos - 1) and across it by p sin.
inline Point moved_by(Point p, double half) {
  const double x = std::abs(p.x), y = std::abs(p.y), second = 0.5 * half * half;
  return {(y * half + x * second) * exact::kOutwards, (x * half + y * second) * exact::kOutwards};
}
/// What is at least as far in both axes.
inline Point farther(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }
inline Point farther_by(Point a, double by) { return {a.x + by, a.y + by}; }

/// Cells of the sum that are inside it at every angle within `half` of the one at which the turning operand's vertices
/// are `turned`.
CoveredCells covered_cells(const TurnGrid& base, const std::vector<Point>& turned, double half);

}  // namespace dymsum::planar
