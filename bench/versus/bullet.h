// What Bullet says of convex solids and of meshes.
#pragma once

#include <memory>

#include "dymsum/mesh.h"

namespace dymsum::bench {

/// Two convex solids as hulls of points without margins, in double precision.
class BulletPair {
 public:
  BulletPair(const Mesh& p, const Mesh& q);
  ~BulletPair();
  /// btGjkEpaSolver2: the penetration depth; 0 where it says that they are apart, NaN where it has no answer.
  double depth(Point3 q_moved_by) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

struct BulletMeshes {
  std::size_t contacts = 0;
  double deepest = 0;  ///< of all contacts
};
/// btGImpactMeshShape on both sides, margins of 0; triangles only.
BulletMeshes bullet_meshes(const MeshData& p, const MeshData& q, Point3 q_moved_by);

}  // namespace dymsum::bench
