// Orientations as the lattice wants them, and angles of any size less whole turns.
#pragma once

#include "dymsum/orientation.h"
#include "exact/big.h"
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

/// radians - 2 pi k in (-pi, pi], exactly reduced and then rounded once: within 2^-52, for every finite double. Beyond
/// half a turn what is within 2^-50 of a multiple of a quarter turn is that multiple, as doubles give it. Up to half a
/// turn nothing is changed, but that -pi is pi. Requires a finite argument.
double reduced_angle(double radians);
/// The same for an angle that no double says, below 2^1024 in magnitude: the nearest double up to half a turn.
double reduced_angle(const exact::BigRational& radians);
/// The same for degrees of any size: multiples of a quarter turn are those, as doubles give them, and everything else
/// is rounded once.
double reduced_degrees(const exact::BigRational& degrees);

}  // namespace dymsum::planar
