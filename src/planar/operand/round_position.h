// Places known by their exact positions alone.
#pragma once

#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// Gives a position the doubles of its exact position, and their error. Rounded from the start of its segment, whose
/// doubles are those that filters have of it.
void round_position(const Lattice& lattice, SegmentPosition& position);

}  // namespace dymsum::planar
