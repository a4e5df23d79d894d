// Exact rotations of space.
#pragma once

#include <array>
#include <cstdint>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/scale.h"

namespace dymsum {

/// A rotation given by an integer quaternion (w, x, y, z) of any length, so that its matrix is rational and exact:
/// R = N / (w^2 + x^2 + y^2 + z^2) with an integer matrix N. Components are at most 2^30 in magnitude, without common
/// divisor, the first one that is not zero positive: equal rotations are equal values.
class Rotation {
 public:
  static constexpr int kBits = 30;
  /// Rounding a quaternion to kBits turns by at most this angle.
  static constexpr double kAngularError = 0x1p-28;

  Rotation() = default;  ///< the identity

  /// Errors: bad_rotation when all components are zero, or larger than 2^30 without common divisor.
  static Result<Rotation> of(std::int64_t w, std::int64_t x, std::int64_t y, std::int64_t z);
  /// A rotation about an axis through the origin, counter-clockwise seen from its tip; exact for the identity, half
  /// turns about and quarter turns about the axes of coordinates, else within kAngularError of the doubles given.
  /// Errors: bad_rotation for a zero axis or numbers that are not finite.
  static Result<Rotation> about(Point3 axis, double radians);
  /// The rotation of a quaternion of doubles, within kAngularError.
  static Result<Rotation> nearest(double w, double x, double y, double z);

  /// First b, then a. Exact when the product fits kBits; else rounded, within kAngularError: compositions do not grow.
  friend Rotation operator*(const Rotation& a, const Rotation& b);
  Rotation inverse() const;

  const std::array<std::int64_t, 4>& quaternion() const { return q_; }
  /// N, row by row; entries at most 2^62 in magnitude.
  std::array<std::int64_t, 9> matrix() const;
  /// The denominator of N.
  std::int64_t norm() const;
  /// The angle, in [0, pi].
  double angle() const;

  friend bool operator==(const Rotation&, const Rotation&) = default;

 private:
  std::array<std::int64_t, 4> q_{1, 0, 0, 0};
};

/// The pose of a solid: x -> rotation (diag(scale) x). Translation moves a sum along and is left to the caller.
struct SolidPose {
  Rotation rotation;
  std::array<Scale, 3> scale;
  friend bool operator==(const SolidPose&, const SolidPose&) = default;
};

}  // namespace dymsum
