// Winding numbers of closed surfaces on both sides of the cells of their arrangement.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

struct CellWindings {
  std::vector<std::int32_t> above;  ///< per cell, on the side of its plane's normal
  std::uint64_t components = 0;     ///< of the surfaces: parts that share no point
  std::uint64_t volumes = 0;        ///< pieces of space, each counted once for every component that bounds it
};

/// The first edge of the arrangement around which the cells do not close: the winding number changes on the way around
/// it. None where the triangles together are closed surfaces. O(n).
std::optional<std::uint32_t> open_edge(const SolidArrangement& arrangement);

/// Winding numbers of triangles of the space's P, where its Q is one vertex. Requires closed surfaces, and that around
/// every sheet lie edges of cells. The winding number below a cell is that above it, plus the facets that face the
/// normal's way, less the others; it is the same for all cells that look into one wedge around an edge; and for every
/// component it is counted at one position. Exact. O(n log n), or O(n) for few components.
CellWindings cell_windings(const SumSpace& space, const SolidArrangement& arrangement,
                           const std::vector<Triangle>& triangles, StageWatch& watch);

}  // namespace dymsum::spatial
