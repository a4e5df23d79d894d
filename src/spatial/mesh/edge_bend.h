// How the faces of a mesh meet at its edges.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"
#include "spatial/mesh/face_plane.h"
#include "spatial/mesh/half_edges.h"

namespace dymsum::spatial {

enum class Bend {
  flat,    ///< in one plane, side by side
  convex,  ///< the solid's angle is below 180 degrees
  reflex,  ///< above
  folded   ///< in one plane, on top of each other: an angle of 0 or 360 degrees
};

/// The planes of all faces, by face_plane.
std::vector<FacePlane> face_planes(const MeshData& data);

/// How the two faces at half-edge h meet. Requires valid faces and a twin. Exact. O(k) for k collinear vertices there.
Bend edge_bend(const MeshData& data, const HalfEdges& edges, const std::vector<FacePlane>& planes, std::uint32_t h);

}  // namespace dymsum::spatial
