// Rings from frame to frame: their canonical order, and which one is which.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "planar/position/vertex_order.h"

namespace dymsum::planar {

/// Of all parts, the outer ring of each first.
std::vector<const SumRing*> rings_of(const PlanarSum& sum);

/// Hashes of what names a contact and a vertex.
std::uint64_t mixed(std::uint64_t h, std::uint64_t v);
std::uint64_t key(const Contact& c);
std::uint64_t key(const SumVertex& v);

/// Where a ring's lexicographically smallest vertex stands. Requires |at - exact| <= at_error, and no two vertices at
/// one place.
std::size_t smallest_vertex(const std::vector<SumVertex>& vertices, const VertexOrder& order, double at_error);

/// Puts rings, each from its smallest vertex on, into the sum in canonical order; `outer` tells the counter-clockwise
/// ones. Returns for each ring of the sum, in the order of rings_of, its number in `rings`. Requires: no two rings
/// touch.
std::vector<std::size_t> place_rings(std::vector<SumRing> rings, const std::vector<std::uint8_t>& outer,
                                     PlanarSum& sum);

/// The identities of rings that are handed on from frame to frame.
class RingIdentities {
 public:
  std::uint64_t fresh() { return next_++; }
  /// Of the rings of `after`, from those of `before` whose identities are given: each takes that of the first ring with
  /// which it shares a vertex, unless it is taken. Lists what changed, not sorted.
  std::vector<std::uint64_t> match(const PlanarSum& before, const std::vector<std::uint64_t>& ids,
                                   const PlanarSum& after, bool same_place, FrameChanges& changes);

 private:
  std::uint64_t next_ = 1;
};

/// Sorts the changed rings and tells what else differs.
void finish_changes(const PlanarSum& before, const PlanarSum& after, FrameChanges& changes);

}  // namespace dymsum::planar
