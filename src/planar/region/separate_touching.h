// Regions whose rings touch, rewritten so that the engine's local view holds: at every visit of a vertex the wedge on
// the left is one whole sector of the region, and components have connected interiors.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::planar {

/// Region data for the engine, with the numbers its vertices and edges have in the region they come from.
struct EngineRegion {
  const RegionData* borrowed = nullptr;  ///< without touching points: the region's own data, which must outlive this
  RegionData own;
  bool touching = false;                                    ///< edges of different rings may follow each other
  std::vector<std::uint32_t> vertex_numbers, edge_numbers;  ///< empty: unchanged

  const RegionData& data() const { return borrowed != nullptr ? *borrowed : own; }
  std::uint32_t vertex_number(std::uint32_t v) const { return vertex_numbers.empty() ? v : vertex_numbers[v]; }
  std::uint32_t edge_number(std::uint32_t e) const { return edge_numbers.empty() ? e : edge_numbers[e]; }
};

/// The same set. Without touching points: the data as they are, borrowed. Otherwise edges are cut at touching points,
/// every way in is joined to the next way out clockwise, and rings are grouped anew; they may then visit a point
/// several times.
EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points);

}  // namespace dymsum::planar
