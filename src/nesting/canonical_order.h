// One order for equal sets: what rounds to the same rings has the same bytes, whichever way it was found.
#pragma once

#include "dymsum/region.h"

namespace dymsum::nesting {

/// Every ring from its lexicographically smallest rotation, every segment from its smaller end, negative zeros as
/// zeros; then holes, parts, polylines and points sorted. Requires polylines of two vertices. O(n log n), and O(n) more
/// for every further time that a ring visits its smallest vertex.
void put_in_order(RegionData& data);

}  // namespace dymsum::nesting
