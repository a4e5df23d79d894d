// How far poses are apart, as directions see it, and the map between two operands' frames in doubles.
#pragma once

#include "dymsum/rotation.h"
#include "spatial/mesh/vec3.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

/// The factors of a scale in doubles, each within 2^-53 of its size.
Vec3 scale_factors(const SolidPose& pose);

/// A bound that is at least the angle by which a scaling from one to the other turns a direction or a normal.
double angle_of_scaling(const Vec3& from, const Vec3& to);

/// Unit quaternions (w, x, y, z), each component within 2^-49.
struct UnitQuaternion {
  double w = 1;
  Vec3 v;
};
/// The quaternion of the rotation from Q's frame to P's.
UnitQuaternion relative_rotation(const Rotation& p, const Rotation& q);
/// Entries within 2^-46.
Mat3 matrix_of(const UnitQuaternion& q);
/// A bound that is at least the angle of the rotation from one to the other.
double angle_between(const UnitQuaternion& a, const UnitQuaternion& b);

}  // namespace dymsum::spatial
