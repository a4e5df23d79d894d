// The stages of a sum by winding numbers as data for pictures: dymsum/trace.h.
#pragma once

#include <vector>

#include "dymsum/trace.h"
#include "planar/boundary/winding_boundary.h"

namespace dymsum::planar {

void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
                    PlanarTrace& trace);

}  // namespace dymsum::planar
