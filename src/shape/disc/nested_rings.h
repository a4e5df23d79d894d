// The parts in which holes lie, where what the rings touch does not decide.
#pragma once

#include "shape/disc/disc_positions.h"
#include "shape/disc/disc_set.h"
#include "shape/disc/lazy_vector.h"

namespace dymsum::shape {

/// A ring with the set on its left, and what is known of the part that it bounds.
struct PlacedRing {
  DiscRing ring;
  bool outer = false;
  std::vector<std::uint32_t> sites;    ///< piece -> the site that the corner at its start lies on, if that is a contact
  std::optional<std::uint32_t> owner;  ///< rings with the same one bound one part
  std::optional<Point> anchor;         ///< a vertex of the region in that part
};

/// Parts of rings that do not cross: every hole goes to the part of its owner or, where no outer ring has that, to the
/// innermost outer ring around it. Exact. Requires: arcs are concave as seen from the set, and outer rings have
/// different owners. Cost: one pass over all outer rings for each hole that no owner tells about.
std::vector<DiscPart> nested(const DiscPositions& positions, std::vector<PlacedRing> rings);

}  // namespace dymsum::shape
