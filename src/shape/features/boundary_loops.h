// The boundary as closed loops of vertices, in the order of the sites of a complex: what lies between two contacts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/complex/complex.h"
#include "shape/complex/walks.h"

namespace dymsum::shape {

/// A vertex of a loop, reflex or convex. The loop's edge after it leads to the next one.
struct LoopVertex {
  Point at;
  std::uint32_t vertex = 0;       ///< of the region
  std::uint32_t edge = kNoIndex;  ///< site of the loop edge that starts here; kNoIndex for a region's isolated point
  bool convex = false;            ///< a site of its own
};

/// Vertices [first, last) of a closed loop.
struct BoundaryLoop {
  std::uint32_t first = 0, last = 0, component = 0;
  bool encloses = false;  ///< the discs around it lie in what it bounds: the loop of a hole
  /// Convex vertices, not in line, from which a ray leads to infinity without coming near the loop again: no pocket has
  /// one of them inside. Of loops that enclose: none.
  std::array<std::uint32_t, 3> outermost{kNoIndex, kNoIndex, kNoIndex};
};

struct BoundaryLoops {
  std::vector<LoopVertex> vertices;
  std::vector<BoundaryLoop> loops;
  std::vector<std::uint32_t> loop_of;  ///< loop vertex -> loop
  std::vector<std::uint32_t> before;   ///< site -> the last loop vertex strictly before a contact with it
  std::vector<std::uint32_t> after;    ///< site -> the first one strictly after it
  std::vector<std::uint32_t> loop_of_site;
  std::vector<std::uint32_t> rank;  ///< of loop vertices: see canonical_ranks

  std::uint32_t next(std::uint32_t v) const;
  std::uint32_t previous(std::uint32_t v) const;
};

/// Vertices first, next(first), ..., last of one loop.
struct BoundaryChain {
  std::uint32_t loop = 0, first = 0, last = 0;
};

std::uint32_t length(const BoundaryLoops& loops, const BoundaryChain& chain);
bool holds(const BoundaryLoops& loops, const BoundaryChain& chain, std::uint32_t vertex);

/// O(sites).
BoundaryLoops boundary_loops(const Complex& complex);

// An order of the boundary's vertices that says nothing of where the region lies, which way it is turned or mirrored,
// how large it is, or where its rings begin: for ties.

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
