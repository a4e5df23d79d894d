// Rings with curves, nested, and on one side of their curves.
#pragma once

#include <vector>

#include "io/region/curves.h"
#include "io/region/ring_order.h"

namespace dymsum::io {

/// Nests closed chains, whose last vertices are not repeated, as nest_rings does by their vertices on the curves; then
/// every ring is the version of its chain inside of the region, or outside, as `bound` says. False as nest_rings.
bool nest_chains(std::vector<ChordChain> chains, std::vector<Part>& parts, CurveBound bound,
                 FillRule rule = FillRule::even_odd);

/// The versions of rings of one part, the outer one first, as `bound` says; the part is oriented.
Part part_of_chains(std::vector<ChordChain> rings, CurveBound bound);

}  // namespace dymsum::io
