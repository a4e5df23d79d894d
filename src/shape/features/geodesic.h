// Shortest paths inside a pocket from its bridge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/features/position.h"

namespace dymsum::shape {

/// Triangles of a simple polygon, counter-clockwise, by indices of its vertices. Vertices in line and positions where
/// the polygon touches itself from outside are allowed. Requires: counter-clockwise. Exact. O(n^2) signs at most.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<Position>& polygon);

/// The length, for every vertex of the chain, of the shortest path from the bridge from - to that stays in the pocket,
/// the polygon from, to, and the chain backwards; the pocket lies to the left of from -> to. Which way the paths go is
/// decided exactly; their lengths are the nearest doubles.
std::vector<double> distances_from_bridge(const Position& from, const std::vector<Position>& chain, const Position& to);

}  // namespace dymsum::shape
