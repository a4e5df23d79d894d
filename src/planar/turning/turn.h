// Orientations as the lattice wants them.
#pragma once

#include "dymsum/orientation.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// tan(theta / 2) = n / d in lowest terms, d >= 0; half a turn is 1 / 0.
struct TanHalf {
  exact::BigInteger n, d;
};
TanHalf tan_half_of(const Orientation& orientation);
Orientation orientation_of(const exact::BigRational& tan_half);
/// 2 atan(t), half a turn more in chart 1.
Orientation orientation_at(int chart, const exact::BigRational& t);
/// The rotation of operand `op`, in lowest terms.
LatticeScale turn_of(const Orientation& orientation, std::uint32_t op);

}  // namespace dymsum::planar
