// The boundary of a region as directed edges with the discs on their right, joined so that each closed walk bounds
// free space that is connected there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "shape/complex/complex.h"

namespace dymsum::shape {

struct HalfEdge {
  std::uint32_t from = 0, to = 0;  ///< points
  std::uint32_t index = 0;         ///< of the edge in the region
  std::uint32_t from_index = 0;    ///< of a vertex of the region that lies at `from`
};

struct HalfEdges {
  std::vector<Point> points;  ///< no two equal, lexicographically
  std::vector<HalfEdge> edges;
  std::vector<std::uint32_t> next;                                ///< edge -> edge
  std::vector<std::pair<std::uint32_t, std::uint32_t>> isolated;  ///< points that are components; vertex indices
  std::vector<std::uint32_t> component;                           ///< point -> connected piece of the region
};

/// Edges are cut at the positions where rings touch. Outside, a polyline is there and back; inside, polylines and
/// points are nothing. Errors: as make_complex. O(n log n) for n vertices that touch at O(log n) places.
Result<HalfEdges> make_half_edges(const Region& region, Side side);

}  // namespace dymsum::shape
