// Cuts of a region at its reflex vertices, one after the other.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/decomposition.h"

namespace dymsum::shape {

/// The rings of a region without polylines and points, by the indices of their vertices.
struct RingTable {
  std::vector<Point> at;
  std::vector<std::uint32_t> next, previous, ring;
  std::vector<bool> is_hole;  ///< per ring
};
RingTable ring_table(const Region& region);

RationalPoint rational_point(Point p);

/// The cuts for the minima of these bars, in their order. O(n) steps in doubles and a few exact ones per bar.
std::vector<Cut> find_cuts(const RingTable& table, const std::vector<FeatureBar>& bars,
                           const std::vector<std::uint32_t>& order);

/// The connected components of the region without the cuts. O((n + cuts) cuts).
std::vector<Piece> pieces_between(const RingTable& table, const std::vector<Cut>& cuts);

}  // namespace dymsum::shape
