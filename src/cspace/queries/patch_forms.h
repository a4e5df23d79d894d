// The patches of a configuration-space obstacle as functions of the angle, in doubles with stated errors, and as ranges
// over intervals of angles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/doubles.h"
#include "cspace/queries/range.h"
#include "dymsum/cspace_obstacle.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {

using base::DoublePair;

/// (cosine, sine) of an angle.
struct Turn {
  double c = 1, s = 0;
  explicit Turn(double theta) : c(std::cos(theta)), s(std::sin(theta)) {}
  Point operator*(Point v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
};

/// a + R(theta) b: a corner of the boundary while it lasts.
struct Hinge {
  Point a, b;
};

/// The line of a contact: from `start` along `along`, which turns with theta where `turns`; the edge ends at factor 1.
struct ContactLine {
  Hinge start;
  Point along, unit;
  double length = 0;
  bool turns = false;
};

/// An end of a patch: a hinge, or the crossing with another line. Where along the edge that is, as a length from its
/// start: at a hinge always `at`. A crossing of two lines that both turn or both do not is at
/// constant + cosine cos(theta) + sine sin(theta), up to `error` where they are nearly parallel. Else the lines are
/// parallel at `parallel` and half a turn later, and with psi = theta - parallel - k pi it is at constant - tangent
/// tan(psi / 2) + gap[k] / sin(psi). There the gap, the distance of the lines while they are parallel, has its relative
/// accuracy, and is 0 exactly where they coincide. Where it is short the crossing runs fast; then `half_tangent` tells
/// the parallel angle more exactly: its tan(parallel / 2), and that of the angle less half a turn.
struct PatchEnd {
  bool corner = true;
  Hinge hinge;
  double at = 0;
  ContactLine other;
  bool mixed = false;
  double constant = 0, cosine = 0, sine = 0, error = 0, tangent = 0, parallel = 0;
  std::array<double, 2> gap{};
  std::array<DoublePair, 2> half_tangent{};
  /// Any fraction is right: more angles are kept with more digits.
  static constexpr double kFastFraction = 0x1p-13;
  bool fast(int k, double length) const {
    const double g = std::abs(gap[static_cast<std::size_t>(k)]);
    return g != 0 && g < kFastFraction * length;
  }
};

/// Positions are relative to PatchForms::origin, all lengths in its units.
struct PatchForm {
  ContactLine own;
  PatchEnd left, right;
};

/// An interval of a patch: angles [low, high] within (-pi, pi], up to one rounding.
struct PatchPiece {
  std::uint32_t patch = 0;
  double low = 0, high = 0;
};

/// More than event angles (kAngleDouble, and the width of their intervals) and the angles of questions (8 u) err,
/// together.
inline constexpr double kAngleMargin = exact::rounding_bound(2 * 12 + 8, 128);

/// A position in doubles; each coordinate errs by at most `error`, infinite where the lines look parallel.
struct PlacedEnd {
  Point at;
  double error = 0;
};

class PatchForms {
 public:
  explicit PatchForms(const CspaceObstacle& obstacle);

  const std::vector<PatchForm>& forms() const { return forms_; }
  const PatchForm& operator[](std::uint32_t patch) const { return forms_[patch]; }
  Point origin() const { return origin_; }
  Point relative(Point v) const { return in_units({v.x - origin_.x, v.y - origin_.y}); }
  /// Units are a power of two, at most 1, for which no square of a length that matters underflows.
  double in_units(double length) const { return per_unit_ * length; }
  Point in_units(Point v) const { return {per_unit_ * v.x, per_unit_ * v.y}; }
  double unit() const { return 1 / per_unit_; }
  /// No vertex of a slice is farther from the origin; no vertex of the robot is farther from the reference point than
  /// reach().
  double size() const { return size_; }
  double reach() const { return reach_; }
  /// kAngleMargin, or twice the width of an event angle's interval.
  double angle_margin() const { return angle_margin_; }

  /// Proved: lines that coincide somewhere are not taken for granted.
  PlacedEnd end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const;
  /// A box around a patch while the angle is within `half` of `theta`, roundings included.
  PointRange box(const PatchForm& form, double theta, double half) const;

  /// The intervals of a patch, none longer than `longest`.
  static void split(const CspaceObstacle& obstacle, std::uint32_t patch, double longest, std::vector<PatchPiece>& out);

 private:
  std::vector<PatchForm> forms_;
  Point origin_;
  double per_unit_ = 1;
  double size_ = 0, reach_ = 0, angle_margin_ = kAngleMargin;
};

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point position(const Hinge& h, const Turn& turn) { return h.a + turn * h.b; }
inline Point direction(const ContactLine& l, const Turn& turn) { return l.turns ? turn * l.along : l.along; }

inline Point quarter(Point v) { return {-v.y, v.x}; }

}  // namespace dymsum::cspace
