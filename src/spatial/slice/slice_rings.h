// Rings around cells of a slice.
#pragma once

#include <functional>
#include <vector>

#include "spatial/slice/slice_plane.h"

namespace dymsum::spatial {

/// The rings that bound the union of some cells, as half-edges with the union to the left. A ring comes by no point
/// twice; inside of each the union is connected.
std::vector<std::vector<std::uint32_t>> rings_around(const PlaneCells& cells,
                                                     const std::function<bool(std::uint32_t cell)>& taken);

/// The point at which a half-edge begins.
inline PointId start_of(const PlaneCells& cells, std::uint32_t half_edge) {
  const CellEdge& e = cells.edges[half_edge / 2];
  return half_edge & 1 ? e.b : e.a;
}

}  // namespace dymsum::spatial
