// The boundary of a sum where the winding number of a convolution changes between positive and not.
#pragma once

#include <vector>

#include "planar/boundary/collision.h"
#include "planar/boundary/graph_rings.h"
#include "planar/boundary/raw_boundary.h"
#include "planar/boundary/winding_numbers.h"

namespace dymsum::planar {

/// The rings around what has a positive winding number, the inside. Edges are named by segments that bound the sum
/// there: those that are counted positively and run the same way. `sides`: the winding numbers beside the edges of the
/// graph.
GraphRings winding_rings(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides);

/// Appends cracks and punctures: candidates inside the boundary that a collision test does not find in the open sum.
/// Grows `error` to the largest error of a position.
void find_tight_features(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides,
                         Collision& collision, RawBoundary& out, double& error);

}  // namespace dymsum::planar
