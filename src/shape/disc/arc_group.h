// The arcs about one connected part of the complex below a level.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/disc/disc_arcs.h"

namespace dymsum::shape {

/// Adds the fragments of these arcs, the overlaps and the touches of their discs.
void cut_group(const DiscPositions& positions, ArcSet& arcs, const std::vector<std::uint32_t>& members);

}  // namespace dymsum::shape
