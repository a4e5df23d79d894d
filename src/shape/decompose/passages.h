// The passages of a cut over holes that it ignores.
#pragma once

#include <vector>

#include "shape/decompose/cut_search.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {

/// The positions of a cut on holes of its part that do not stand, in order along it. Exact.
std::vector<Passage> passages(const RingTable& table, const WallSet& walls, const Wall& cut,
                              const std::vector<bool>& stands);

/// What of a cut lies inside the region, given where it passes holes.
std::vector<RationalSegment> runs_of(const Cut& cut, const std::vector<Passage>& over);

}  // namespace dymsum::shape
