// The facets of a sum of convex solids from the overlay of their Gauss maps.
#pragma once

#include <cstdint>
#include <utility>

#include "dymsum/convex_sum.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// Vertices and facets of the sum, canonical, without positions. Coplanar facets are one: in the outward direction of
/// every face of P and Q the facet is the sum of the features that are extreme there; every crossing of the interiors
/// of two arcs gives a parallelogram.
void assemble(const Overlay& overlay, SolidSum& sum);

/// A corner of a facet of the generic sum, as vertices of P and Q: of face `id` of operand op with its extreme vertex,
/// or (op = 2) of a crossing.
std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& overlay, int op, std::uint32_t id);

}  // namespace dymsum::spatial
