// What makes a facet of the sum: its corners as pairs of vertices, and its features. Read off the overlay of the Gauss
// maps, for one face or crossing at a time.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

// A vertex of a sum.

/// A vertex of P plus a vertex of Q, as indices of the polytopes.
struct VertexPair {
  std::uint32_t p = 0, q = 0;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};
constexpr VertexPair kNoPair{~std::uint32_t{0}, ~std::uint32_t{0}};

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

// The facets of a sum that have to be looked at exactly.

/// The facets of an overlay of merged operands for which something may be truly zero. Of all others its words say what
/// they are: append_face_and_vertex, and a crossing that crosses_properly.
class CloseFacets {
 public:
  /// O(faces + crossings). No memory is allocated once warm.
  void find(const Overlay& overlay);
  bool of_face(int op, std::uint32_t f) const { return faces_[op][f] != 0; }
  bool of_crossing(std::uint32_t id) const { return crossings_[id] != 0; }
  /// Memory held beside this.
  std::size_t bytes() const { return faces_[0].capacity() + faces_[1].capacity() + crossings_.capacity(); }

 private:
  std::array<std::vector<std::uint8_t>, 2> faces_;
  std::vector<std::uint8_t> crossings_;
};

}  // namespace dymsum::spatial
