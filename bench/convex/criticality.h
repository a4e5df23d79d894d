// The criticality map against moving sums: memory and time.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "dymsum/solids.h"
#include "thesis/criticality_map.h"

namespace dymsum::bench {

/// Times are means of processor time.
struct CriticalityRow {
  std::string p, q;
  std::size_t p_triangles = 0, q_triangles = 0, angles = 0, map_bytes = 0, sum_bytes = 0;
  CriticalityStats stats;
  double build_ms = 0;
  double structure_us = 0,
         update_us = 0;  ///< of one of 500 steps: reading the structure from the map, updating a ConvexSum
  double map_sum_us = 0, update_sum_us = 0;  ///< the same up to the exact sum with positions
  std::size_t compared = 0, different = 0;   ///< sums of both
};

CriticalityRow measure_criticality(const solids::NamedMesh& p, const solids::NamedMesh& q,
                                   std::array<std::int32_t, 3> axis);

}  // namespace dymsum::bench
