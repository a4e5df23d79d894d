// The data of a region as the engine takes it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::exact {
struct HomogeneousPoint;
}

namespace dymsum::planar {

/// Region data for the engine, with the numbers its vertices and edges have in the region they come from.
struct EngineRegion {
  const RegionData* borrowed = nullptr;  ///< without touching points: the region's own data, which must outlive this
  RegionData own;
  bool touching = false;                                    ///< edges of different rings may follow each other
  std::vector<std::uint32_t> vertex_indices, edge_indices;  ///< empty: unchanged

  /// The exact positions of all vertices in their order, where some are no doubles: `own` has the nearest doubles then.
  /// Otherwise none.
  std::shared_ptr<const std::vector<exact::HomogeneousPoint>> fractions;

  const RegionData& data() const { return borrowed != nullptr ? *borrowed : own; }
  std::uint32_t vertex_index(std::uint32_t v) const { return vertex_indices.empty() ? v : vertex_indices[v]; }
  std::uint32_t edge_index(std::uint32_t e) const { return edge_indices.empty() ? e : edge_indices[e]; }
};

}  // namespace dymsum::planar
