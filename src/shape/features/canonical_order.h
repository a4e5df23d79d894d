// An order of the boundary's vertices that says nothing of where the region lies, which way it is turned or mirrored,
// how large it is, or where its rings begin: for ties.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/complex/walks.h"
#include "shape/features/boundary_loops.h"

namespace dymsum::shape {

/// Loop vertex -> rank, by the distance from the mean of all loop vertices, then by what follows along the loop in
/// either direction, distances and lengths of edges. Where that leaves ties all are looked at in one frame: its origin
/// is the mean, its first axis goes through a vertex, it is mirrored or not; the frame in which the region looks least
/// is chosen. Frames that look the same are images of each other under a symmetry of the region, so that whatever is
/// decided by these ranks is decided, up to a congruence, by geometry alone. Only vertices at one position have indices
/// for a tie. Exact. O(n log^2 n), with symmetries n log n for each vertex of the rarest kind: rational coordinates
/// have at most eight symmetries.
std::vector<std::uint32_t> canonical_ranks(const BoundaryLoops& loops, const Walks& walks);

/// The ranks of what the discs on an edge of a complex touch: two for each site, the lesser one first.
using ContactRanks = std::array<std::uint32_t, 4>;
ContactRanks contact_ranks(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge);

}  // namespace dymsum::shape
