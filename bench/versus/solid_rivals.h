// Other systems on convex solids, behind plain interfaces: CGAL's convex hull of all vertex sums, and the penetration
// depths of FCL and libccd.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::bench {

/// CGAL::convex_hull_3 (EPICK) of all sums of a vertex of p and a vertex of q, as its users compute convex Minkowski
/// sums.
struct HullAnswer {
  double ms = 0;
  std::size_t vertices = 0;
  double volume = 0;
};
HullAnswer cgal_hull_of_sums(const std::vector<Point3>& p, const std::vector<Point3>& q);

/// CGAL::minkowski_sum_3 on Nef polyhedra (EPECK) of the hulls of the vertices. Seconds for a few dozen faces.
struct NefAnswer {
  double ms = 0;
  std::size_t vertices = 0;
  double volume = 0;
};
/// Of solids of any shape without holes in faces. Minutes for a hundred triangles.
NefAnswer cgal_nef_sum_of_solids(const MeshData& p, const MeshData& q);
NefAnswer cgal_nef_sum(const std::vector<Point3>& p, const std::vector<Point3>& q);

enum class DepthRival { fcl, fcl_tight, ccd_gjk_epa, ccd_mpr };
const char* name(DepthRival rival);

/// A pair of convex solids prepared for repeated queries; q is moved by a translation, p is turned by the matrix given.
class DepthPair {
 public:
  DepthPair(const Mesh& p, const Mesh& q);
  ~DepthPair();
  /// The penetration depth; 0 when the rival says that they are apart. `matrix` is row by row.
  double depth(DepthRival rival, const double (&matrix)[9], Point3 q_moved_by) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace dymsum::bench
