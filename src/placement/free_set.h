// The closed set of positions that lie in none of some open sets, from what of their boundaries is free: a result like
// any other.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/planar_sum.h"
#include "placement/free_boundary.h"

namespace dymsum::placement {

/// A vertex of the set: the end of an edge of a part or of a segment, or a point.
struct SetVertex {
  enum class Of : std::uint8_t { part, segment, point };
  Of of = Of::part;
  SumVertex vertex;
  std::vector<std::uint32_t> touches;  ///< ids of the sets on whose boundary it lies, ascending
};

struct FreeSet {
  PlanarSum set;                    ///< what has no room beside it is listed as tight too
  std::vector<SetVertex> vertices;  ///< by x, then y; each position once
};

/// Requires: the set is bounded; `sets` are all that the boundaries name, which the result keeps. O(n log n).
FreeSet free_set(std::span<const FreeBoundary* const> boundaries, std::vector<std::shared_ptr<const PlacedSet>> sets);

}  // namespace dymsum::placement
