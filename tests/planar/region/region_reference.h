// A validator of regions by definition, for coordinates that are small integers, 0 to 4: all pairs of edges and of
// strands, and nesting by counting how often each point of the grid of thirds is covered: every face that lattice rings
// bound without crossing contains a lattice triangle, and with it the triangle's centroid. Shares no code with Region.
#pragma once

#include <string>

#include "dymsum/region.h"

namespace dymsum::test {

/// "valid" or the name of the error's code; two names joined by " or " where either is right.
std::string reference_verdict(const RegionData& data);

/// True when the ring's signed area is positive.
bool encloses_counter_clockwise(const Ring& ring);

}  // namespace dymsum::test
