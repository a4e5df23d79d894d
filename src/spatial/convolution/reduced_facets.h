// The reduced convolution of two solids: facets that together contain every position in which the solids touch without
// overlapping, and whose back sides lie in the open sum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

// Normals and edges of operands in doubles with a bound, for signs that integers then need not find.

/// A vector in doubles: within `error` of the exact one in each component, both scaled so that the largest component is
/// about 1.
struct Direction {
  Vec3 v;
  double error = 0;
};

inline Direction scaled_direction(Vec3 v, double error) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 4 * error)) return {{0, 0, 0}, 4};  // says nothing
  return {(1 / size) * v, error / size + 0x1p-51};
}

inline double direction_norm(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// The direction from one vertex to another, each coordinate of either within `each` of the exact one.
inline Direction edge_direction(Vec3 from, Vec3 to, double each) {
  const Vec3 d = to - from;
  return scaled_direction(d, 2 * each + direction_norm(d) * 0x1p-52);
}

/// The normal of a triangle, likewise.
inline Direction normal_direction(Vec3 a, Vec3 b, Vec3 c, double each) {
  const Vec3 u = b - a, v = c - a;
  const double error =
      direction_norm(u) * direction_norm(v) * 0x1p-50 + 4 * each * (direction_norm(u) + direction_norm(v) + each);
  return scaled_direction(cross(u, v), error);
}

/// The sign of n . d; 0 where doubles leave it open.
inline int filtered_sign(const Direction& n, const Direction& d) {
  const double v = dot(n.v, d.v);
  const double error = 3 * (n.error + d.error + n.error * d.error) + 0x1p-49;
  return v > error ? 1 : v < -error ? -1 : 0;
}

/// A convex polygon: a triangle of one operand plus a vertex of the other, or an edge plus an edge, a parallelogram.
struct SumFacet {
  enum class Kind : std::uint8_t { face_vertex, vertex_face, edge_edge } kind = Kind::face_vertex;
  std::uint8_t corners = 3;
  std::uint32_t p = 0, q = 0;        ///< triangle, vertex or wedge of either operand
  std::array<SumPoint, 4> corner{};  ///< counter-clockwise seen from the side of the normal, which is the outer one
};

struct ConvolutionCounts {
  std::uint64_t face_vertex = 0, edge_edge = 0;
  std::uint64_t pairs_tried = 0;
};

struct ReducedConvolution {
  std::vector<SumFacet> facets;
  std::vector<PlaneSource> planes;  ///< of the facets
  ConvolutionCounts counts;
};

/// Statement: docs/design/solid-sum.md, "Facets". Exact. Cost: the pairs of faces and vertices, and of edges, whose
/// sets of normals have overlapping boxes on the sphere of directions.
ReducedConvolution reduced_convolution(const SumSpace& space, const SolidOperand& p, const SolidOperand& q,
                                       StageWatch& watch);

// When two features make a facet of the reduced convolution, and which facet: docs/design/solid-sum.md, "Facets".

/// The signs at a convex edge e of P and one, g, of Q: of g on the normals of e's left and right face, and of e on
/// those of g's.
struct EdgePairSigns {
  int e_left = 0, e_right = 0, g_left = 0, g_right = 0;
  bool any_zero() const { return e_left == 0 || e_right == 0 || g_left == 0 || g_right == 0; }
};

/// The side s = 1 or -1 of the facet that two convex edges of solid parts make, the sign of its normal along e x g, but
/// for ties; 0 where they make none.
inline int edge_pair_side(const EdgePairSigns& at) {
  // With n = s (e x g) and d, c from the edges into their faces, n . d <= 0 and n . c <= 0 read, for the faces'
  // normals: s (g . n_left) >= 0 >= s (g . n_right), s (e . m_left) <= 0 <= s (e . m_right). All zero: parallel edges.
  if (at.e_left == at.e_right) return 0;
  const int s = at.e_left != 0 ? at.e_left : -at.e_right;
  return s * at.e_right > 0 || s * at.g_left > 0 || s * at.g_right < 0 ? 0 : s;
}

/// The rule for a face of one edge that is coplanar with the facet: the ray of the other edge on its side has to be
/// lexicographically positive. Returns whether that holds for wedges e of P and g of Q. Exact.
bool ties_hold(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const Wedge& e, const Wedge& g,
               const EdgePairSigns& at);

/// The sign of a triangle's normal times a direction. Exact.
int normal_sign(const SumSpace& space, DirectionSource::Of of, const Triangle& triangle, DirectionSource d);

/// Whether triangle t of one operand (`of`) and a cone of the other one make a facet. Exact.
bool makes_facet(const SumSpace& space, DirectionSource::Of of, const SolidOperand& faces, std::uint32_t t,
                 const SolidOperand& vertices, const SupportCone& cone);
/// The side of the facet that two convex wedges of solid parts make, 0 where they make none. Exact.
int facet_side(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, std::uint32_t e, std::uint32_t g);

/// The facets themselves: of a triangle of `of` and a vertex of the other operand, of wedges of P and of Q.
SumFacet face_vertex_facet(DirectionSource::Of of, const SolidOperand& faces, std::uint32_t t, std::uint32_t vertex);
SumFacet edge_edge_facet(const SolidOperand& p, const SolidOperand& q, std::uint32_t e, std::uint32_t g, int side);
PlaneSource plane_of(const SumFacet& facet);

}  // namespace dymsum::spatial
