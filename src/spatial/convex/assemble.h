// The facets of a sum of convex solids from the overlay of their Gauss maps.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// Vertices and facets of the sum, canonical, without positions. Coplanar facets are one: in the outward direction of
/// every face of P and Q the facet is the sum of the features that are extreme there; every crossing of the interiors
/// of two arcs gives a parallelogram.
void assemble(const Overlay& overlay, SolidSum& sum);

/// The feature of the other operand that is extreme in the direction of face f of operand op: its vertices
/// counter-clockwise seen from outside, and, of a face, its index in the polytope.
struct ExtremeFeature {
  std::vector<std::uint32_t> vertices;
  std::uint32_t face = 0;
};
ExtremeFeature extreme_feature(const Overlay& overlay, int op, std::uint32_t f);

/// Whether two arcs cross in their interiors, not only after the infinitesimal rotation.
bool crosses_properly(const Overlay& overlay, const Crossing& crossing);

/// A corner of a facet of the generic sum, as vertices of P and Q: of face `id` of operand op with its extreme vertex,
/// or (op = 2) of a crossing.
std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& overlay, int op, std::uint32_t id);

/// The public names of features of a polytope.
SolidFeature vertex_feature(const Polytope& p, std::uint32_t v);
SolidFeature edge_feature(const Polytope& p, std::uint32_t a, std::uint32_t b);
SolidFeature face_feature(const Polytope& p, std::uint32_t f);

}  // namespace dymsum::spatial
