// When two features make a facet of the reduced convolution, and which facet: docs/design/solid-sum.md, "Facets".
#pragma once

#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

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
