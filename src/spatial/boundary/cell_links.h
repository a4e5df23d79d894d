// The cells of the arrangement that bound the sum: around every edge the cells' sides that look into one wedge of space
// belong together.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"

namespace dymsum::spatial {

/// What lies on the sides of a cell.
enum class CellState : std::uint8_t {
  covered,   ///< both sides in the open sum
  boundary,  ///< the side that its facets face is outside
};

struct CellLinks {
  std::vector<std::uint32_t>
      patch;  ///< per cell: cells whose front sides are connected have the same index; kNoId for covered ones
  std::uint32_t patches = 0;
};

/// Statement and proof: docs/design/solid-sum.md, "Links". A cell that facets of both directions cover has no patch,
/// and one of neither is looked through. With a scope only cells and edges in it are linked, and other cells have no
/// patch.
CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch,
                     const ArrangementScope* scope = nullptr);

}  // namespace dymsum::spatial
