// The sum of two convex polygons, segments or points that lie in parallel planes: a facet of a sum where directions
// coincide.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/convex/vertex_pair.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {

/// p and q: vertices of P and Q, counter-clockwise seen against the outward normal of face f of operand op, to which
/// both are perpendicular. Returns the true vertices of the sum, in that order: edges of equal direction become one.
std::vector<VertexPair> plane_sum(const Signs& signs, const std::vector<std::uint32_t>& p,
                                  const std::vector<std::uint32_t>& q, int op, std::uint32_t f);

}  // namespace dymsum::spatial
