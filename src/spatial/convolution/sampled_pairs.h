// How many facets of a convolution will lie near one another, from a sample of them.
#pragma once

#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// The expected number of pairs of facets whose boxes overlap: of the facets of some hundred triangles and edges, drawn
/// evenly, the pairs that do, times what each stands for. In doubles, P being turned by a thousandth so that parallel
/// faces and edges are in general position. Parts without volume are left out. O(s (m + n) + f^2) for s drawn features
/// with f facets.
double sampled_pairs(const SolidOperand& p, const SolidOperand& q);

}  // namespace dymsum::spatial
