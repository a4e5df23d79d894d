// The cells, edges and points of a slice that lie in the sum.
#pragma once

#include <vector>

#include "spatial/boundary/collision.h"
#include "spatial/slice/slice_plane.h"

namespace dymsum::spatial {

enum class SliceState : std::uint8_t {
  outside,   ///< not in the sum
  touching,  ///< in the sum: the solids touch and do not overlap
  open,      ///< in the open sum
};

struct SliceStates {
  std::vector<SliceState> cells;
  std::vector<std::uint32_t> cracks, threads;  ///< edges: touching between open cells; in the sum between outer ones
  std::vector<PointId> punctures, dots;        ///< points of PlaneCells: likewise
};

/// Statement: docs/design/solid-sum.md, "Slices". Exact.
SliceStates slice_states(const SlicePlane& plane, const Collision& collision);

}  // namespace dymsum::spatial
