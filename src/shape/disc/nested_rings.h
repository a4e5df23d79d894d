// Which hole lies in which part, where nothing else tells.
#pragma once

#include "shape/disc/disc_set.h"

namespace dymsum::shape {

/// Parts of rings that do not cross, the set on their left: every hole goes to the innermost outer ring around it, by
/// winding numbers about a corner of the hole. Requires: arcs are concave as seen from the set. Cost: one pass over all
/// outer rings for each hole, where there are several.
std::vector<DiscPart> nested(std::vector<DiscRing> rings, Corners corners);

}  // namespace dymsum::shape
