// Orientations as the lattice wants them.
#pragma once

#include "dymsum/orientation.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

Orientation orientation_of(const exact::BigRational& tan_half);
/// 2 atan(t), half a turn more in chart 1.
Orientation orientation_at(int chart, const exact::BigRational& t);
/// The rotation of operand `op`, in lowest terms.
LatticeScale turn_of(const Orientation& orientation, std::uint32_t op);

}  // namespace dymsum::planar
