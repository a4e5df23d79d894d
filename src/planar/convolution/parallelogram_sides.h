// What pairs of edges add without any area in either operand: in the closed sum parallelograms.
#pragma once

#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Whether there are any: in open sums they are none.
bool makes_parallelograms(Semantics semantics, const Operand& p, const Operand& q);

/// Two sides of the parallelogram of every pair of edges of two components without area that turns left; as polylines
/// are walked there and back, those of the backward edges close it, counter-clockwise. O(n m) for n and m such edges.
std::vector<WalkSegment> parallelogram_sides(const Lattice& lattice, const Operand& p, const Operand& q);

}  // namespace dymsum::planar
