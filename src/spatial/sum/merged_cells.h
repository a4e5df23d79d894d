// Cells of one plane put together to polygons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/convolution/stage_watch.h"

namespace dymsum::spatial {

/// The cells that belong to what is put together, and the side from which it is seen: 0 for cells that do not, 1 for
/// the normal's side, -1 for the other one.
struct Selection {
  std::vector<std::int8_t> side;
};

/// A polygon as loops of points of the arrangement, counter-clockwise around its inside.
struct CellPolygon {
  std::vector<std::vector<PointId>> loops;
  std::uint32_t cell = 0;  ///< one of its cells
};

/// The selected cells as polygons: a piece of a line that two of them in one plane share, and nothing else that is
/// selected touches, is no face edge; a point where all face edges run along one line is no corner, unless it is one of
/// `corners`.
std::vector<CellPolygon> merged_cells(const SumSpace& space, const SolidArrangement& arrangement,
                                      const Selection& selection, std::span<const PointId> corners, StageWatch& watch);

}  // namespace dymsum::spatial
