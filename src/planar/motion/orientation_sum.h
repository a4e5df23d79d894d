// The operands of a pair at one orientation, and their sum: on the lattice of rotated vertices.
#pragma once

#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "planar/operand/placed_pair.h"

namespace dymsum::planar {

class OperandPair;

PlacedPair placed_at(const OperandPair& base, const Orientation& theta);
Result<PlanarSum> sum_at(const OperandPair& base, const Orientation& theta, const SumOptions& options);

}  // namespace dymsum::planar
