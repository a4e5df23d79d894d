// The sum of two convex polygons, segments or points that lie in parallel planes: a facet of a sum where directions
// coincide.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spatial/convex/vertex_pair.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {

/// A vertex, an edge or a face of a polytope: the half-edges round it, counter-clockwise seen from outside (none, both
/// of an edge, all of a face), and the vertex from which the first one leaves.
struct FlatFeature {
  std::uint32_t vertex = 0;
  std::span<const HalfEdge> edges;
};

/// p and q: features of P and Q that are perpendicular to the outward normal of face f of operand op. Appends the true
/// vertices of their sum, counter-clockwise seen against that normal: edges of equal direction become one. O(edges),
/// exact where doubles do not decide.
void append_plane_sum(const Signs& signs, const FlatFeature& p, const FlatFeature& q, int op, std::uint32_t f,
                      std::vector<VertexPair>& sum);

}  // namespace dymsum::spatial
