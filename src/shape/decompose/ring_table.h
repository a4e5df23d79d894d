// The rings of a region without polylines and points, by the indices of their vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"

namespace dymsum::shape {

struct RingTable {
  std::vector<Point> at;
  std::vector<std::uint32_t> next, previous, ring;
  std::vector<std::uint32_t> first;  ///< per ring, and the number of vertices after the last
  std::vector<std::uint32_t> part;   ///< per ring
  std::vector<bool> is_hole;         ///< per ring

  std::uint32_t ring_count() const { return std::uint32_t(part.size()); }
};
RingTable ring_table(const Region& region);

RationalPoint rational_point(Point p);

}  // namespace dymsum::shape
