// Exact orientations of the plane: rotations by angles whose half has a rational tangent. They are dense, and rotated
// vertices are rational.
#pragma once

#include <cstdint>
#include <string_view>

#include "dymsum/rational.h"
#include "dymsum/result.h"

namespace dymsum {

namespace planar {
struct OrientationInternals;
}

/// A rotation by theta about the origin, given by t = tan(theta / 2) = n / d: its matrix is (c, -s; s, c) / w with c =
/// d^2 - n^2, s = 2 n d, w = d^2 + n^2. Half a turn is t = infinity. A value: equal orientations compare equal.
class Orientation {
 public:
  /// Angles in radians are met within this at best.
  static constexpr double kAngularError = 0x1p-50;

  Orientation() = default;  ///< theta = 0

  /// Any rational; numerator and denominator have at most 4096 bits. Errors: bad_rotation beyond that.
  static Result<Orientation> of(const Rational& tan_half);
  /// t = n / d; half a turn for d = 0. Errors: bad_rotation for 0 / 0.
  static Result<Orientation> of(std::int64_t n, std::int64_t d);
  static Orientation half_turn();
  /// "3/7", "0.25" or "-1e-3", each exactly what it says; "inf" is half a turn. Errors: malformed; bad_rotation.
  static Result<Orientation> parse(std::string_view tan_half);
  /// An orientation within 2^-50 of the angle, which may be any finite double: it is reduced by whole turns exactly.
  /// Quarter turns are met exactly: as doubles give them up to half a turn, and beyond by what is within 2^-50 of their
  /// multiples (the doubles of these up to about 4 pi; farther out a double says what it says). Errors: bad_rotation
  /// for an angle that is not finite.
  static Result<Orientation> nearest(double radians);
  /// An orientation within `error` of the angle, and the simplest one within 0.99 of it: fewer bits, faster exact
  /// signs. Errors: bad_rotation for an angle that is not finite, and for an error below kAngularError, which cannot be
  /// promised.
  static Result<Orientation> nearest(double radians, double error);

  bool is_half_turn() const { return half_turn_; }
  /// Requires: not half a turn (else std::invalid_argument).
  const Rational& tan_half() const;
  double radians() const { return radians_; }  ///< in (-pi, pi], within 2^-50
  Orientation inverse() const;
  /// First b, then a. Exact: the bits of the operands add up.
  friend Orientation operator*(const Orientation& a, const Orientation& b);
  friend bool operator==(const Orientation& a, const Orientation& b) {
    return a.half_turn_ == b.half_turn_ && a.tan_half_ == b.tan_half_;
  }

 private:
  friend struct planar::OrientationInternals;
  Rational tan_half_;  // 0 for half a turn
  bool half_turn_ = false;
  double radians_ = 0;
};

/// An angle less whole turns, in (-pi, pi]: for angles that no double says, as fractions of a long turn. Reduced
/// exactly and rounded once; beyond half a turn what is within 2^-50 of a multiple of a quarter turn is that multiple,
/// as doubles give it. Orientation::nearest of the result is within 2^-50 of the angle. Requires a magnitude below
/// 2^1024 (else std::invalid_argument).
double reduced_radians(const Rational& radians);
/// The same of degrees, in radians: any magnitude; multiples of 90 are quarter turns.
double reduced_degrees(const Rational& degrees);

}  // namespace dymsum
