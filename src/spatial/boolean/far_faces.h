// The faces of solids that nothing of another solid comes near: they need no arrangement, only to be kept or left out
// together with all that they are connected to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/arrangement/near_pairs.h"
#include "spatial/boolean/surface.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// Triangles of solids, near and far. A face (all triangles that flat edges connect) is far where the box of none of
/// its triangles meets one of another solid, every edge of it has exactly two triangles, which run through it in
/// opposite directions, and no vertex lies inside of a straight side of its outline. Far faces that edges connect are a
/// sheet. Each sheet has edges in common with near triangles, its rim: a surface without any has one near face.
///
/// Nothing of another solid meets a far face, nor the edges and vertices of one, and so cuts it.
struct FarFaces {
  std::vector<std::uint32_t> near;   ///< the near triangles, ascending
  std::vector<std::uint32_t> sheet;  ///< per triangle; kNoId for near ones
  std::vector<std::uint32_t> twin;   ///< per half-edge 3 t + k, from corner k of t on: the one on its edge's other side
  std::vector<std::uint8_t> flat;    ///< per half-edge of a far face: whether the twin's triangle lies in its plane
  /// Per sheet: its sides beside near triangles, from a vertex to another one, the sheet to the left.
  std::vector<std::vector<std::array<std::uint32_t, 2>>> rims;
};

/// Requires a surface of solids, and all pairs of triangles of different ones whose boxes meet. Exact. O(n log n).
FarFaces far_faces(const Surface& surface, const NearPairs& pairs, StageWatch& watch);

/// The outlines of a far face by one of its triangles: loops of half-edges, the face to their left. Marks all of its
/// triangles as seen.
std::vector<std::vector<std::uint32_t>> outlines(const FarFaces& faces, std::uint32_t first,
                                                 std::vector<std::uint8_t>& seen);

}  // namespace dymsum::spatial
