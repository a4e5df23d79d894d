// What the boundaries of two placed open sets have in common, edge by edge: where they meet, and which parts of an edge
// lie in the other set.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "placement/placed_set.h"

namespace dymsum::placement {

/// What lies between two neighbouring cuts of an edge.
struct Gap {
  bool covered = false;        ///< in the other set
  bool along = false;          ///< on its boundary
  bool right_covered = false;  ///< along, and the other set lies on the right
};

/// An edge that the other set covers, or meets.
struct EdgeCover {
  std::uint32_t edge = 0;
  std::vector<Site> cuts;  ///< in order along the edge; an end is one where it lies on the other boundary
  std::vector<Gap> gaps;   ///< one more than cuts; the first and the last are empty where the end is a cut
};

/// All edges of a set that `by` covers or meets, in order.
struct Cover {
  const PlacedSet* by = nullptr;
  std::vector<EdgeCover> edges;
};

/// The covers of `a` by `b` and of `b` by `a`. Requires: different ids.
/// O(n + m + k) for pairs of edges whose boxes meet, and a ray through `b` for each piece of a's boundary between cuts
/// whose sides a plain crossing does not say.
std::array<Cover, 2> covers(const PlacedSet& a, const PlacedSet& b);

/// Whether a position that does not lie on the boundary of a set lies in it. O(n) for a set of long edges, else those
/// of a row.
bool lies_in(const PlacedSet& set, const Probe& probe);

}  // namespace dymsum::placement
