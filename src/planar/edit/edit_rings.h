// Cycles of an edited arrangement as rings of the sum.
#pragma once

#include <span>

#include "planar/edit/edit_arrangement.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// The ring of a cycle, with collinear steps merged, from its smallest vertex on; grows `error` to the largest error of
/// a position, in units of the lattice. The vertices are those of a sum from scratch.
SumRing ring_of_steps(const EditArrangement& arrangement, std::span<const LiveSubEdge> steps, const ExactSource& source,
                      double& error);

/// The vertices of a ring in the indices after an edit. Requires: all features of the ring are still there.
void rename_vertices(SumRing& ring, const std::array<WalkChanges, 2>& walks);

}  // namespace dymsum::planar
