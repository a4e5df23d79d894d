// The nesting of shells: the depth of a shell is the number of others around it. A solid's shells run outward where the
// depth is even, and inward, around a cavity, where it is odd.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// The other shells around every one, in ascending order. Requires faces that share nothing but common vertices and
/// edges (surface_crossings.h). Exact: signs of orientations of three and four vertices. O(log n) and the triangles in
/// the way of one ray for every shell.
std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells,
                                                      const Triangles& triangles, const BoxTree& boxes);
/// How many these are. Requires and cost as above.
std::vector<std::uint32_t> shell_depths(const MeshData& data, const Shells& shells, const Triangles& triangles,
                                        const BoxTree& boxes);

}  // namespace dymsum::spatial
