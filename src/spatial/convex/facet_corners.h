// What makes a facet of the sum: its corners as pairs of vertices, and its features. Read off the overlay of the Gauss
// maps, for one face or crossing at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/vertex_pair.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// The features of P and Q whose sum a facet is, and, where a face faces the same way as one of the other operand, the
/// index of that.
struct FacetFeatures {
  SolidFeature p, q;
  std::uint32_t parallel = kNoFace;
};

/// The facet in the direction of face f of operand op: its corners are appended, counter-clockwise seen from outside.
/// Looks for truly level edges at the extreme vertex; where there are any, the smallest pair comes first. Nothing is
/// appended where f is a face of Q and P has one that faces the same way, whose facet it is.
FacetFeatures append_face(const Overlay& overlay, int op, std::uint32_t f, std::vector<VertexPair>& corners);

/// The same where it is known that all edges at the extreme vertex truly fall: face + vertex. O(corners).
FacetFeatures append_face_and_vertex(const Overlay& overlay, int op, std::uint32_t f, std::vector<VertexPair>& corners);

/// The parallelogram of a crossing of the interiors of two arcs.
FacetFeatures append_crossing(const Overlay& overlay, const Crossing& crossing, std::vector<VertexPair>& corners);

/// Whether two arcs cross in their interiors, not only after the infinitesimal rotation.
bool crosses_properly(const Overlay& overlay, const Crossing& crossing);

/// The public names of features of a polytope.
SolidFeature vertex_feature(const Polytope& p, std::uint32_t v);
SolidFeature edge_feature(const Polytope& p, std::uint32_t a, std::uint32_t b);
SolidFeature face_feature(const Polytope& p, std::uint32_t f);

}  // namespace dymsum::spatial
