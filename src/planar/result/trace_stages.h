// The stages of a sum as data for pictures: dymsum/trace.h.
#pragma once

#include "dymsum/trace.h"
#include "planar/boundary/boundary.h"
#include "planar/convolution/convolution.h"

namespace dymsum::planar {

void trace_stages(const Soup& soup, const InteriorMask* mask, const Arrangement& arrangement, const SortedLoops& loops,
                  const ReducedConvolution& convolution, PlanarTrace& trace);

}  // namespace dymsum::planar
