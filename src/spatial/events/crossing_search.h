// Edges that pass through two facets, and fours of facets, as far as jets decide that they may have a point in common.
#pragma once

#include <functional>
#include <vector>

#include "spatial/events/facet_cells.h"
#include "spatial/events/rotation_candidates.h"

namespace dymsum::spatial {

/// Whether a position provably lies beyond a edge of a facet; inward(k): the vector into it across facet edge k.
template <class Signs, class F>
bool provably_outside(const Signs& signs, const WindowFacet& f, const typename Signs::Position& at, F inward) {
  const int w = at.w.sign();
  if (w == 0) return false;
  for (int k = 0; k < f.facet.corners; ++k)
    if (signs.inside(inward(k), f.facet.corner[k], at).sign() * w < 0) return true;
  return false;
}

/// Calls take(meeting) for all candidates in the angles of a frame, those of a window or one: edges_and_facets in the
/// order of edges and facets, then four_facets in that of facets; until it says false. Only facets that exist in a
/// common cell, by `cells`, are looked at together. Boxes are those of `boxes`, at the same angles at least. `again` is
/// called now and then and may throw. Frame is JetFrame or FineFrame.
template <class Frame>
void find_crossings(const RotationWindow& window, const Frame& frame, const JetFrame& boxes,
                    std::vector<RotationCells> cells, const std::function<void()>& again,
                    const std::function<bool(const Meeting&)>& take);

}  // namespace dymsum::spatial
