// The stages of a sum as data for pictures: dymsum/trace.h.
#pragma once

#include <vector>

#include "dymsum/trace.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/winding_boundary.h"
#include "planar/convolution/convolution.h"

namespace dymsum::planar {

void trace_stages(const Soup& soup, const InteriorMask* mask, const Arrangement& arrangement, const SortedLoops& loops,
                  const ReducedConvolution& convolution, PlanarTrace& trace);
/// The same of a sum by winding numbers.
void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
                    PlanarTrace& trace);

}  // namespace dymsum::planar
