// What FCL says of meshes that need not be convex.
#pragma once

#include "dymsum/mesh.h"

namespace dymsum::bench {

struct MeshAnswer {
  double signed_distance = 0;  ///< of fcl::distance with enable_signed_distance; below 0 inside
  double deepest = 0;          ///< the largest depth of a contact of fcl::collide
  std::size_t contacts = 0;    ///< at most 1000 are requested
  double us = 0;               ///< of both
};

/// BVHModel<OBBRSS>; q moved by a translation. Triangles only.
MeshAnswer fcl_mesh_distance(const MeshData& p, const MeshData& q, Point3 q_moved_by);

}  // namespace dymsum::bench
