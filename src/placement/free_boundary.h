// What of the boundary of an open set lies in none of the others: the boundary of the positions that are free of all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "placement/boundary_meetings.h"

namespace dymsum::placement {

/// A position that lies in no set, and those on whose boundary it lies.
struct FreeNode {
  Site at;
  std::vector<std::uint32_t> touches;  ///< their ids, ascending
};

/// A part of an edge that lies in no set, between two neighbouring nodes.
struct FreePiece {
  EdgeOf edge;
  FreeNode from, to;
  bool beside = false;  ///< what lies on its right is free too
};

struct FreeBoundary {
  std::vector<FreePiece> pieces;  ///< those that lie along an edge of a set with a smaller id left out
  std::vector<FreeNode> nodes;    ///< of which no neighbour on the edge is free
};

/// Of the boundary of `set`, given its covers by all others that it meets or that cover some of it. O(n + k log k) for
/// k cuts of edges.
FreeBoundary free_boundary(const PlacedSet& set, std::span<const Cover* const> covers);

}  // namespace dymsum::placement
