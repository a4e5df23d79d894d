// Orientations as the lattice wants them, and angles of any size less whole turns.
#pragma once

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation.h"
#include "exact/algebraic_root.h"
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

// Algebraic angles as values: their exact order in (-pi, pi], doubles that enclose them, and orientations between them.

/// An angle as a root in one of two charts, so that half turns need no exception: theta = 2 atan(t) + pi chart, t in
/// (-1, 1]. Chart 0 covers (-pi/2, pi/2], chart 1 the rest.
struct ExactAngle {
  int chart = 0;
  exact::AlgebraicRoot t;
};

/// The angle of an orientation. Exact.
ExactAngle exact_angle(const Orientation& theta);

/// The sign of a - b, both in (-pi, pi]. Exact; doubles decide where the roots' own bounds are apart.
int compare(const ExactAngle& a, const ExactAngle& b);

/// What is public of an angle: the doubles enclose it, being equal only for 0; `exact` is set where the tangent of the
/// half angle is rational.
EventAngle event_angle(const ExactAngle& angle);

/// An orientation strictly inside the way from a counter-clockwise to b, the whole turn without a when they are equal:
/// a multiple of a quarter turn if there is one, else n / 2^k in the chart of the angles with the smallest k.
Orientation orientation_between(const ExactAngle& a, const ExactAngle& b);

}  // namespace dymsum::planar
