// The rings of a region without polylines and points, by the indices of their vertices.
#pragma once

#include <cstdint>
#include <optional>
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
  std::vector<std::uint32_t> rank;   ///< of vertices, for ties: see canonical_ranks

  bool is_reflex(std::uint32_t v) const;
  /// Rings by the least ranks of their vertices.
  std::vector<std::uint32_t> ranked_rings() const;

  std::uint32_t ring_count() const { return std::uint32_t(part.size()); }
};
/// Requires: ranks for the vertices of the region, different ones; none for those in an edge.
RingTable ring_table(const Region& region, const std::vector<std::optional<std::uint32_t>>& rank);

RationalPoint rational_point(Point p);

}  // namespace dymsum::shape
