// The boundary of the sum of two convex operands: nothing has to be intersected.
#pragma once

#include <optional>

#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// The boundary of P + Q when both operands are one component with a convex outer loop whose holes the other one fills:
/// the outer edges of both in the order of their directions, interior on the left. Nothing for other operands. O(n + m)
/// for n and m edges, of which equal or nearly equal directions are compared exactly.
std::optional<SumRing> convex_boundary(const Lattice& lattice, const Operand& p, const Operand& q);

}  // namespace dymsum::planar
