// Cells of the sum that stay inside it while an operand turns a little: what windows of angles are made with.
#pragma once

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

/// Cells of the sum that are inside it at every angle within `half` of the one at which the turning operand's vertices
/// are `turned`.
CoveredCells covered_cells(const TurnGrid& base, const std::vector<Point>& turned, double half);

}  // namespace dymsum::planar
