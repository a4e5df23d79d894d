// Planes of what touches on the faces of a sum in motion, by names: it does not matter which of several coplanar pairs
// of features names a face.
#pragma once

#include "spatial/motion/posed_pair.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

/// A hash of the hyperplane n . x = d0 + s d1 of what two features make, in lowest terms, whichever side is its front.
std::uint64_t plane_name(const ScalingPair& pair, const SolidContact& contact);
/// The same for planes that are one at all angles, as walls along the axis are: that of plane_hash in chart 0.
std::uint64_t plane_name(const RotatingPair& pair, const SolidContact& contact);

/// A hash of the equation of a plane at one t modulo the prime 2^61 - 1, up to a factor: equal for planes that are one
/// at every angle. Equal hashes of others are a coincidence of one in 2^60.
std::uint64_t plane_hash(const PolynomialFrame& frame, const PlaneSource& plane);

}  // namespace dymsum::spatial
