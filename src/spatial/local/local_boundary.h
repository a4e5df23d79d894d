// The stages of a sum near a position: docs/design/local-sum.md.
#pragma once

#include "spatial/local/clip_walls.h"
#include "spatial/moving/posed_sum.h"

namespace dymsum::spatial {

/// Whether a facet's box overlaps a box of the space.
bool comes_near(const SumSpace& space, const SumFacet& facet, const Box& box);

/// A position of the box that is queried: whether anything bounds the sum in the box or not, or only where nothing
/// does.
struct Centre {
  std::array<exact::BigRational, 3> at;
  bool always = false;
};

struct LocalBoundary {
  SolidBoundary boundary;      ///< its cells and tight features lie in the box
  bool centre_inside = false;  ///< the centre lies in the open sum, where it was queried
};

/// Requires the facets near the larger box of the walls, in a space with positions for them; all facets for `brute`,
/// where every cell and place of the whole sum is tested by itself.
LocalBoundary local_boundary(PosedSpace& space, ReducedConvolution convolution, const SolidPair& pair, ClipWalls& walls,
                             const Centre& centre, const SpatialOptions& options, SpatialStats& stats,
                             StageWatch& watch);

}  // namespace dymsum::spatial
