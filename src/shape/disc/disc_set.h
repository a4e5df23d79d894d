// From rings of pieces to sets.
#pragma once

#include "dymsum/growing_disc.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

/// Boundaries whose corners all turn clockwise, as those of sums do, or counter-clockwise.
enum class Corners : std::uint8_t { clockwise, counter_clockwise };

/// A ring with the set on its left, and a name for the part that it belongs to.
struct OwnedRing {
  DiscRing ring;
  std::uint32_t owner = 0;
};

/// The same curve the other way round.
DiscRing reversed(std::vector<DiscPiece> pieces);

/// Whether a ring runs counter-clockwise. It turns by 2 pi one way or the other in all: what doubles err by does not
/// matter as long as it is less than that.
bool is_outer(const DiscRing& ring, Corners corners);

/// One part for each owner: its outer ring and its holes. Requires: one outer ring for each.
std::vector<DiscPart> parts_of(std::vector<OwnedRing> rings, Corners corners);

/// The region itself: radius 0.
DiscSet set_of(const Region& region);

}  // namespace dymsum::shape
