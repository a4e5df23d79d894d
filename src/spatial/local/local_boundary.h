// The stages of a sum near a place: docs/design/local-sum.md.
#pragma once

#include "spatial/local/clip_walls.h"
#include "spatial/moving/posed_sum.h"

namespace dymsum::spatial {

/// Facets whose boxes overlap a box of the space.
ReducedConvolution facets_near(const SumSpace& space, const Box& box, const ReducedConvolution& all);

struct LocalBoundary {
  SolidBoundary boundary;    ///< its cells and tight features lie in the box
  bool middle_inside = false;  ///< the middle of the box lies in the open sum; only where nothing bounds it there
};

/// Requires the facets near the larger box of the walls, in a space with places for them; all facets for `brute`, where
/// every cell and place of the whole sum is tested by itself.
LocalBoundary local_boundary(PosedSpace& space, ReducedConvolution convolution, const SolidPair& pair,
                             ClipWalls& walls, const ClipBox& box, const SpatialOptions& options, SpatialStats& stats,
                             StageWatch& watch);

}  // namespace dymsum::spatial
