// The four sets of a level.
#pragma once

#include "shape/disc/disc_positions.h"
#include "shape/disc/disc_set.h"
#include "shape/disc/level_rings.h"

namespace dymsum::shape {

// Requires: a radius above 0; sum and closing the outer complex, erosion and opening the inner one.
DiscSet sum_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics);
DiscSet eroded_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics);
DiscSet opened_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics);
DiscSet closed_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics);

/// Radius and at_error of a set whose rings are known.
void finish(const DiscPositions& positions, DiscSet& set);

}  // namespace dymsum::shape
