// The cells, edges and points of a slice put together to a planar set.
#pragma once

#include "dymsum/solid_slice.h"
#include "spatial/slice/slice_states.h"

namespace dymsum::spatial {

/// Fills section, touching and contacts, in canonical order. Takes the plane's space.
void collect_region(SlicePlane plane, const SliceStates& states, const SolidOperand& p, const SolidOperand& q,
                    SolidSlice& slice);

}  // namespace dymsum::spatial
