// Where a cut passes over holes that it ignores.
#pragma once

#include <vector>

#include "shape/decompose/cut_search.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {

/// The places of a cut on holes of its part that do not stand, in order along it. Exact.
std::vector<Passage> passages(const RingTable& table, const WallSet& walls, const Wall& cut,
                              const std::vector<bool>& stands);

}  // namespace dymsum::shape
