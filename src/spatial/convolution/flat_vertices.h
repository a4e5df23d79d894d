// The same surface with fewer triangles: vertices inside faces and straight edges left out.
#pragma once

#include <span>
#include <vector>

#include "spatial/convolution/solid_operand.h"

namespace dymsum::spatial {

/// Vertices inside a straight edge, or around which all triangles lie in one plane, are left out of a
/// surface, and what they leave is split into triangles anew; every triangle gets the smallest face among those
/// connected to it in its plane. `wedges` and `wedge_of` are those of the triangles. Vertices stay where `keep` marks
/// them (nowhere, where it is empty), at edges with more than two triangles, and where several fans meet. Exact. Cost:
/// O(k) for the triangles, and triangulated() for every vertex left out, about those with the fewest neighbours first.
Triangles without_flat_vertices(const std::vector<Point3>& vertices, Triangles surface, std::span<const Wedge> wedges,
                                std::span<const std::uint32_t> wedge_of, const std::vector<bool>& keep);

}  // namespace dymsum::spatial
