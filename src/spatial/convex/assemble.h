// The facets of a sum of convex solids from the overlay of their Gauss maps.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// The facets of a sum without positions. Coplanar facets are one: in the outward direction of every face of P and Q
/// the facet is the sum of the features that are extreme there; every crossing of the interiors of two arcs gives a
/// parallelogram.
struct ConvexFacets {
  struct Facet {
    std::size_t first;  ///< its corners are corners[first], ...
    std::uint32_t count;
    bool changed;  ///< not there before the last move
    SolidFeature p, q;
  };
  std::vector<ConvexSum::Vertex> vertices;
  std::vector<std::uint32_t> corners;  ///< indices of vertices; of a facet counter-clockwise seen from outside
  std::vector<Facet> facets;
};
ConvexFacets assemble(const Overlay& overlay);

/// A corner of a facet of the generic sum, as vertices of P and Q: of face `id` of operand op with its extreme vertex,
/// or (op = 2) of a crossing.
std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& overlay, int op, std::uint32_t id);

}  // namespace dymsum::spatial
