// The Gauss map of one operand in its own frame: normals, arcs of convex edges, and what cones of vertices support, as
// unit vectors in doubles.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/grid_positions.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// Every component of the unit vectors is within this of the exact one.
inline constexpr double kUnitError = 0x1p-48;
/// The product of two of them, one turned by matrix_of of another 2^-46: beyond this its sign is the exact one.
inline constexpr double kSignError = 0x1p-43;

/// The normals between those of an edge's faces lie in a ball of `radius` about `centre`, which are chords: distances
/// between unit vectors, which no turn by some angle changes by more than that.
struct GaussArc {
  Vec3 centre;
  double radius = 0;
};

class GaussSide {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Unscaled. Requires an operand without thin parts, which has to live as long.
  GaussSide(const SolidOperand& solid, const GridPositions& positions);
  /// Scales along the axes of its frame.
  void scale(Vec3 factors);

  const SolidOperand& solid;
  std::vector<Vec3> normals;             ///< of triangles
  std::vector<std::uint32_t> convex;     ///< the wedges of convex edges
  std::vector<std::uint32_t> convex_of;  ///< per wedge: its index among these, or kNone
  std::vector<Vec3> edges;               ///< of these: the direction
  std::vector<GaussArc> arcs;
  std::vector<Vec3> rays;  ///< as solid.rays

  const Wedge& wedge(std::uint32_t convex_edge) const { return solid.wedges[convex[convex_edge]]; }
  /// Calls f for the convex edges of a triangle, at most three.
  template <class F>
  void for_each_edge(std::uint32_t triangle, F f) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (const std::uint32_t e = convex_of[solid.wedge_of[3 * triangle + k]]; e != kNone) f(e);
  }

 private:
  void set_arcs();
  std::vector<Vec3> own_normals_, own_edges_, own_rays_;  // unscaled, each component within 2^-50 of its size
};

}  // namespace dymsum::spatial
