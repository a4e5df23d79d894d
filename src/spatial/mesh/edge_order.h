// Edges at which a solid touches itself: more than two faces, in their order around the edge.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "spatial/mesh/half_edges.h"

namespace dymsum::spatial {

/// Two sides of one edge, neighbours around it, that run through it in the same direction or lie on each other: no
/// solid has them.
struct SideClash {
  std::uint32_t half_edge = 0, other = 0;
};

/// Joins the sides of every edge as twins, where more than two meet those with the solid's inside between them.
/// Requires faces that are valid by themselves and as many sides of every edge in one direction as in the other.
/// Returns a clash, if there is one. Exact. O(k log k) for k sides of an edge.
std::optional<SideClash> join_around(HalfEdges& edges, const std::vector<EdgeSide>& sides, const MeshData& data);

/// Membranes: the faces that have to be left out so that those at every edge bound inside and outside by turns, each
/// with the inside on both sides of it. What faces of two sides join is one whole, and left out as such. Empty where
/// there are none, where edges contradict each other, or one has a single face. Requires faces that are valid by
/// themselves. Exact. O(n log n).
std::vector<bool> membranes(const MeshData& data);

/// The half-edges of a valid mesh, all with twins.
HalfEdges half_edges(const MeshData& valid);

}  // namespace dymsum::spatial
