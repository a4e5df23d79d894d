// Makes sets of rings of pieces.
#pragma once

#include "dymsum/growing_disc.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

/// A ring with the set on its left, and a name for the part that it belongs to.
struct OwnedRing {
  DiscRing ring;
  std::uint32_t owner = 0;
  bool outer = false;
};

/// The same curve the other way round.
DiscRing reversed(std::vector<DiscPiece> pieces);

/// One part for each owner: its outer ring and its holes. Requires: one outer ring for each.
std::vector<DiscPart> parts_of(std::vector<OwnedRing> rings);

/// The region itself: radius 0.
DiscSet set_of(const Region& region);

}  // namespace dymsum::shape
