// The orientation of faces and shells, made right: a part of the named repair.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/named_repairs.h"
#include "exact/big.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

// Exact volumes of shells.

/// The sign of the volume that each shell encloses: -1 for a shell that is inside out. Requires plane faces and closed
/// shells. Exact. O(n).
std::vector<int> shell_signs(const MeshData& data, const Shells& shells);

/// The exact volume of all shells together.
exact::BigRational exact_volume(const MeshData& data);

// The nesting of shells: the depth of a shell is the number of others around it. A solid's shells run outward where the
// depth is even, and inward, around a cavity, where it is odd.

/// The other shells around every one, in ascending order. Requires faces that share nothing but common vertices and
/// edges (surface_crossings.h). Exact: signs of orientations of three and four vertices. O(log n) and the triangles in
/// the way of one ray for every shell.
std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells,
                                                      const Triangles& triangles, const BoxTree& boxes);
/// How many these are. Requires and cost as above.
std::vector<std::uint32_t> shell_depths(const MeshData& data, const Shells& shells, const Triangles& triangles,
                                        const BoxTree& boxes);

/// Whether every face is valid by itself, and has no vertex twice.
bool all_faces_valid(const MeshData& data);

/// Turns single faces over until all agree with their neighbours, as few as that takes. Only across edges of two faces;
/// what contradicts itself is left as it is. Returns those that were turned. O(n log n).
std::vector<std::uint32_t> turn_faces(MeshData& data);

/// What may be done to shells.
struct ShellRepairs {
  bool reverse = true;  ///< those that are inside out are reversed
  std::optional<NestedShells> nested =
      NestedShells::cavity;  ///< what one inside another one becomes that runs as that does
};

/// What was done to shells, by one face of each.
struct TurnedShells {
  std::vector<std::uint32_t> turned;    ///< that were inside out
  std::vector<std::uint32_t> cavities;  ///< inside others, that ran as these do: they bound cavities now
  std::vector<std::uint32_t> bodies;    ///< inside others, which they add nothing to
  std::vector<bool> dropped;            ///< the faces of these; empty where there are none
};

/// Reverses whole shells. Does nothing where the surface is not closed, or a face not valid. With NestedShells::solid a
/// shell bounds the solid exactly where the shells around it, each +1 where it runs outward and -1 inward, add up to 0
/// on one side of it alone.
TurnedShells turn_shells(MeshData& data, const ShellRepairs& repairs);

}  // namespace dymsum::spatial
