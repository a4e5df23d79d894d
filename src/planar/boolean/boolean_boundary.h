// The boundary of a Boolean expression, from the windings of its inputs.
#pragma once

#include <vector>

#include "planar/boolean/boolean_terms.h"
#include "planar/boolean/input_windings.h"
#include "planar/boolean/joined_inputs.h"
#include "planar/boundary/raw_boundary.h"
#include "planar/result/sum_pieces.h"

namespace dymsum::planar {

/// Rings where faces inside meet faces outside. Cracks and punctures: edges and nodes whose faces are all inside, or
/// all outside, and that lie in the closed set and not in the open one. `pieces`: those of them that lie outside.
struct BooleanBoundary {
  RawBoundary boundary;
  PieceCandidates pieces;
};
BooleanBoundary boolean_boundary(const Soup& soup, const SegmentGraph& graph, const InputWindings& windings,
                                 const SegmentInputs& segments, const BooleanTerms& terms);

}  // namespace dymsum::planar
