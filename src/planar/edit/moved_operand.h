// The operand of a region of which some vertices moved, from the operand before.
#pragma once

#include <memory>

#include "planar/edit/walk_changes.h"

namespace dymsum::planar {

/// What make_operand makes of the region, in O(n) copies. Null where the walk does not stay what it is: vertices that
/// came or went, or are straight or spikes before or after, an extreme vertex that moved, coordinates in other units.
std::shared_ptr<const Operand> moved_operand(const Operand& before, const Region& after, const VertexOrigins& origins);

}  // namespace dymsum::planar
