// Angles of any size less whole turns, without losing digits.
#pragma once

namespace dymsum::planar {

/// radians - 2 pi k in (-pi, pi], exactly reduced and then rounded once: within 2^-52, for every finite double. Beyond
/// half a turn what is within 2^-50 of a multiple of a quarter turn is that multiple, as doubles give it. Up to half a
/// turn nothing is changed, but that -pi is pi. Requires a finite argument.
double reduced_angle(double radians);

}  // namespace dymsum::planar
